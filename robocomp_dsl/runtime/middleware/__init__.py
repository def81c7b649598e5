"""The middlewares, by name. In: a name. Out: a `Middleware` for one component, loaded on demand."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoints

    from robocomp_dsl.runtime.middleware.base import Host, Middleware

GROUP = "robocomp_dsl.middleware"
OWN = {
    "inproc": "robocomp_dsl.runtime.middleware.inproc",
    "zenoh": "robocomp_dsl.runtime.middleware.zenoh",
}


class UnknownMiddleware(Exception):
    """No middleware has this name; the message lists those that there are."""


def names() -> list[str]:
    """All that can be opened here."""
    return sorted({*OWN, *(one.name for one in _installed())})


def open_middleware(name: str, host: Host) -> Middleware:
    """The middleware called `name`, connected for one component.

    Raises `UnknownMiddleware`, or `MiddlewareError` when it cannot be opened.
    """
    if name in OWN:
        return _opened(import_module(OWN[name]).open_for, host)
    for one in _installed():
        if one.name == name:
            return _opened(one.load(), host)
    raise UnknownMiddleware(f"there is no middleware `{name}`; there are {', '.join(names())}")


def _installed() -> EntryPoints:
    """Those of other distributions."""
    from importlib.metadata import entry_points  # noqa: PLC0415 - it takes long to load

    return entry_points(group=GROUP)


def _opened(opener: Callable[[Host], Middleware], host: Host) -> Middleware:
    return opener(host)

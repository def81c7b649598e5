"""Opens middlewares by name, loaded on demand."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoints

    from robocomp_dsl.runtime.connection.ports import ComponentContext, Middleware

ENTRY_POINT_GROUP = "robocomp_dsl.middleware"
BUILT_IN = {
    "inproc": "robocomp_dsl.runtime.middleware.inproc",
    "zenoh": "robocomp_dsl.runtime.middleware.zenoh.middleware",
}


class UnknownMiddleware(Exception):
    """No middleware has this name; the message lists the known ones."""


def middleware_names() -> list[str]:
    """Names of all middlewares that can be opened."""
    return sorted({*BUILT_IN, *(point.name for point in _entry_points())})


def open_middleware(name: str, host: ComponentContext) -> Middleware:
    """The middleware called `name`, connected for one component.

    Raises `UnknownMiddleware`, or `MiddlewareError` when it cannot be opened.
    """
    if name in BUILT_IN:
        return _open(import_module(BUILT_IN[name]).open_for, host)
    for point in _entry_points():
        if point.name == name:
            return _open(point.load(), host)
    raise UnknownMiddleware(f"unknown middleware `{name}`; known: {', '.join(middleware_names())}")


def _entry_points() -> EntryPoints:
    """Middlewares of other distributions."""
    from importlib.metadata import entry_points  # noqa: PLC0415 - it takes long to load

    return entry_points(group=ENTRY_POINT_GROUP)


def _open(opener: Callable[[ComponentContext], Middleware], host: ComponentContext) -> Middleware:
    return opener(host)

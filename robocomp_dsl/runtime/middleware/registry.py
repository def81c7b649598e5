"""Opens middlewares by name, loaded on demand."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

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


@cache
def description_of(name: str) -> MiddlewareDescription | None:
    """The description of a middleware; None if there is none of this name."""
    if name == "inproc":
        return MiddlewareDescription(
            "inproc",
            "all components in one process, for tests",
            Capabilities(
                between_processes=False,
                sequence_numbers=True,
                reports_source=True,
                qos=frozenset({"reliable"}),
            ),
            opener="robocomp_dsl.runtime.middleware.inproc:open_for",
        )
    if name in BUILT_IN:
        module = import_module(f"robocomp_dsl.runtime.middleware.{name}.description")
        built_in: MiddlewareDescription = module.MIDDLEWARE
        return built_in
    for point in _entry_points():
        if point.name == name:
            description: MiddlewareDescription = point.load()
            return description
    return None


def missing_modules(description: MiddlewareDescription) -> list[str]:
    """The modules that a middleware requires and that are not installed."""
    return [name for name in description.requires if find_spec(name.partition(".")[0]) is None]


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

"""The known middlewares: built in, or entry points of other distributions; loaded on demand."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint, EntryPoints

    from robocomp_dsl.runtime.middleware.transport import Transport, TransportContext

ENTRY_POINT_GROUP = "robocomp_dsl.middleware"
BUILT_IN = ("dds", "ice", "inproc", "local", "rmw_zenoh", "ros1", "ros2", "yarp", "zenoh")
DEFAULT = "zenoh"
"""The middleware of a component that names none."""
_broken: dict[str, str] = {}
"""Why entry points could not be loaded, by name."""


class UnknownMiddleware(Exception):
    """No middleware has this name, or it is not installed; the message tells what to do."""


def middleware_names() -> list[str]:
    """Names of all middlewares."""
    return sorted({*BUILT_IN, *(point.name for point in _entry_points())})


@cache
def description_of(name: str) -> MiddlewareDescription | None:
    """The description of a middleware; None if there is none of this name, or it is broken."""
    if name in BUILT_IN:
        module = import_module(f"robocomp_dsl.runtime.middleware.{name}.description")
        built_in: MiddlewareDescription = module.MIDDLEWARE
        return built_in
    for point in _entry_points():
        if point.name == name:
            return _load(point)
    return None


def _load(point: EntryPoint) -> MiddlewareDescription | None:
    """The description that an entry point names; None if it cannot be loaded."""
    distribution = point.dist.name if point.dist else "another distribution"
    try:
        found = point.load()
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
    else:
        if isinstance(found, MiddlewareDescription):
            return found
        reason = f"{point.value} is no MiddlewareDescription"
    _broken[point.name] = (
        f"the middleware `{point.name}` of {distribution} cannot be loaded: {reason};"
        f" update or remove it: pip uninstall {distribution}"
    )
    return None


def capabilities_of(name: str) -> Capabilities:
    """The capabilities of a middleware. Raises `UnknownMiddleware`."""
    return _require(name).capabilities


@cache
def known_capabilities(name: str) -> Capabilities | None:
    """The capabilities of a middleware; None if it is unknown, or not installed."""
    description = description_of(name)
    if description is None or missing_modules(description):
        return None
    return description.capabilities


def missing_modules(description: MiddlewareDescription) -> list[str]:
    """The modules that a middleware requires and that are not installed."""
    return [name for name in description.requires if find_spec(name.partition(".")[0]) is None]


def open_transport(name: str, context: TransportContext) -> Transport:
    """The middleware called `name`, opened for one component.

    Raises `UnknownMiddleware`, or `MiddlewareError` when it cannot be opened.
    """
    description = _require(name)
    if missing := missing_modules(description):
        raise UnknownMiddleware(
            f"the middleware `{name}` needs {', '.join(missing)}; {description.install}"
        )
    module, _, function = description.opener.partition(":")
    transport: Transport = getattr(import_module(module), function)(context)
    return transport


def transport_folder(domain: str, name: str) -> Path:
    """The private folder of a middleware in a domain; it may not exist yet."""
    from robocomp_dsl.runtime.presence.domain_folder import domain_path  # noqa: PLC0415

    return domain_path(domain) / name


def _require(name: str) -> MiddlewareDescription:
    description = description_of(name)
    if description is None:
        if name in _broken:
            raise UnknownMiddleware(_broken[name])
        known = ", ".join(middleware_names())
        raise UnknownMiddleware(f"unknown middleware `{name}`; known: {known}")
    return description


@cache
def _entry_points() -> EntryPoints:
    """Middlewares of other distributions."""
    from importlib.metadata import entry_points  # noqa: PLC0415 - it takes long to load

    return entry_points(group=ENTRY_POINT_GROUP)

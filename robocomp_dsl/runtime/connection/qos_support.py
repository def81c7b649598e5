"""Checks that the middlewares of a port can do what its quality of service asks for.

In: a port. Out: nothing, or `UnsupportedQos` with port, item and middleware. Nothing is ignored
silently.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.middleware.capabilities import QOS_ITEMS

TOPIC_ITEMS = ("keep_all", "latched", "deadline", "liveliness")
RECEIVER_ROLES = ("server", "subscriber")


class UnsupportedQos(MiddlewareError):
    """A middleware, or the role of a port, does not allow an item."""


def check_qos(at: Endpoint, role: str, middlewares: Iterable[str]) -> None:
    """Check a port with a role: `server`, `client`, `publisher` or `subscriber`.

    Every middleware of the port must be able to do what the port asks for; for what one connection
    asks for, that of the connection is enough. Raises `UnsupportedQos`.
    """
    names = tuple(middlewares)
    for problem in _problems(at, role, at.qos, names):
        raise UnsupportedQos(problem)
    for _, items in at.peer_qos:
        problems = [list(_problems(at, role, items, (name,))) for name in names]
        if problems and all(problems):
            raise UnsupportedQos(problems[0][0])


def _problems(at: Endpoint, role: str, qos: Qos, middlewares: tuple[str, ...]) -> Iterator[str]:
    if role in ("server", "client"):
        for item in TOPIC_ITEMS:
            if getattr(qos, item):
                yield (
                    f"port `{at.port}` asks for `{item}`, which only topics have; it is a service:"
                    f" remove `{item}`"
                )
    for name in middlewares:
        capabilities = registry.known_capabilities(name)
        if capabilities is None:
            continue  # opening it reports the reason
        for item in required_items(qos, role):
            if item not in capabilities.qos:
                able = ", ".join(_able(item)) or "no installed middleware"
                yield (
                    f"port `{at.port}` asks for `{item}`, which the middleware `{name}` cannot do;"
                    f" remove it, or use a middleware that can: {able}"
                )


def required_items(qos: Qos, role: str) -> Iterator[str]:
    """The items of `QOS_ITEMS` that need support of the middleware."""
    for item in QOS_ITEMS:
        value = getattr(qos, item)
        if item == "priority":
            if value not in (None, "normal"):
                yield item
        elif value and role in ("publisher", "subscriber"):
            yield item


def _able(item: str) -> list[str]:
    names = registry.middleware_names()
    known = ((name, registry.known_capabilities(name)) for name in names)
    return [name for name, capabilities in known if capabilities and item in capabilities.qos]

"""Names of running components under namespaces: `left/arm`; namespaces nest.

In: names and prefixes. Out: full names, and distances between names. For a component in
`left`, components in `left` are nearest, then those without a namespace; components in `right` are
on another branch and are found only by their full name.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

ANY = "*"
"""Wildcard for a component: any component on the same branch."""
_INNER_DISTANCE = 1000
_FROM = " from "

_T = TypeVar("_T")


def resolve_name(prefix: str, name: str) -> str:
    """The full name of `name` in `prefix`. `/name` is already full; `*.port` stays as it is."""
    if name.startswith("/"):
        return name[1:]
    return f"{prefix}/{name}" if prefix and not name.startswith(ANY) else name


def connection_port(port: str, peer: str) -> str:
    """The name of the own port that the connection of `port` with `peer` (`component.Port`) has.

    A monitored connection has one; only the peer that names it connects to it.
    """
    component, _, peer_port = peer.rpartition(".")
    return f"{port}{_FROM}{component}:{peer_port}"


def is_port_of_connection(name: str, port: str) -> bool:
    """Whether `name` is the port of a connection of `port`."""
    return name.startswith(f"{port}{_FROM}")


def is_connection_port(port: str) -> bool:
    """Whether the port is one of a connection; users cannot write such a name."""
    return _FROM in port


def port_of_connection(port: str) -> str:
    """The port that a connection port belongs to; any other port itself."""
    return port.partition(_FROM)[0]


def namespace_of(component: str) -> str:
    """`left` of `left/arm`."""
    return component.rpartition("/")[0]


def on_same_branch(component: str, other: str) -> bool:
    """Whether one namespace contains the other, or both are the same."""
    if "/" not in component or "/" not in other:
        return True
    mine, theirs = f"{namespace_of(component)}/", f"{namespace_of(other)}/"
    return mine.startswith(theirs) or theirs.startswith(mine)


def distance(component: str, other: str) -> int:
    """Distance on one branch: 0 in the same namespace, then outwards; inner namespaces last."""
    mine, theirs = component.count("/"), other.count("/")
    return mine - theirs if theirs <= mine else _INNER_DISTANCE


def nearest(component: str, found: Sequence[_T], name: Callable[[_T], str]) -> list[_T]:
    """The items of `found` nearest to `component`; `name` returns the component of an item."""
    if len(found) < 2:
        return list(found)
    least = min(distance(component, name(candidate)) for candidate in found)
    return [candidate for candidate in found if distance(component, name(candidate)) == least]

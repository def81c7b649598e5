"""Shared by all middlewares: select the peer of a call.

In: endpoints and candidates. Out: one peer, or the error that says why there is none.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from robocomp_dsl.runtime.component.naming import (
    ANY,
    distance,
    is_connection_port,
    nearest,
    on_same_branch,
)
from robocomp_dsl.runtime.connection.endpoint import NOBODY, Endpoint
from robocomp_dsl.runtime.errors import AmbiguousServer, NoServer

DISCOVERY_TIMEOUT_S = 1.0
"""After the start of a component, its calls wait this long for a server to appear."""

log = logging.getLogger("robocomp")
_T = TypeVar("_T")


def matches(at: Endpoint, component: str, port: str) -> bool:
    """Whether `at` is connected to this port, or may discover it."""
    wired = at.peers
    if f"{component}.{port}" in wired:
        return True
    if is_connection_port(port):
        return False
    if component in wired:
        return True
    any_peer = not wired and not at.external
    return (any_peer or f"{ANY}.{port}" in wired) and on_same_branch(at.component, component)


def eligible_servers(at: Endpoint, found: Sequence[_T], name: Callable[[_T], str]) -> list[_T]:
    """The servers that may be called: all named by a connection, else the nearest."""
    return list(found) if _names_components(at) else nearest(at.component, found, name)


def discovery_complete(at: Endpoint, components: Iterable[str]) -> bool:
    """Whether there is no need to wait for a nearer server.

    Components of one namespace start together: a server of an outer namespace must not be chosen
    because the nearer one starts a moment later.
    """
    if _names_components(at):
        return any(True for _ in components)
    return any(distance(at.component, component) == 0 for component in components)


def _names_components(at: Endpoint) -> bool:
    return any(not peer.startswith(f"{ANY}.") for peer in at.peers)


def select_server(at: Endpoint, candidates: Sequence[str]) -> str:
    """The only candidate (`component.port`). Raises `NoServer` or `AmbiguousServer`."""
    if len(candidates) == 1:
        return candidates[0]
    interface = at.interface.name
    if at.peers == (NOBODY,):
        raise NoServer(f"{at.name} is disconnected; connect it: rcdeploy connect")
    if not candidates:
        subject = f"{' or '.join(at.peers)} does not serve" if at.peers else "no component serves"
        raise NoServer(f"{subject} {interface}, which {at.component} requires as {at.port}")
    ordered = tuple(sorted(candidates))
    raise AmbiguousServer(
        f"{', '.join(ordered)} all serve {interface}, which {at.component} requires as {at.port};"
        f" select one: --connect {at.port}={_shortest_peer(at, ordered)}",
        ordered,
    )


def _shortest_peer(at: Endpoint, candidates: Sequence[str]) -> str:
    """What selects the first candidate: its component, or its port if others are of the same."""
    first = candidates[0]
    component = first.partition(".")[0]
    others = (candidate.partition(".")[0] for candidate in candidates[1:])
    # In a namespace, the name must be absolute.
    return f"{'/' if '/' in at.component else ''}{first if component in others else component}"

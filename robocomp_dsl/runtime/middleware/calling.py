"""Shared by all middlewares: select the peer of a call, and log failures of handlers.

In: endpoints and candidates. Out: one peer, or the error that says why there is none.
"""

from __future__ import annotations

import logging
import os
import time
import traceback
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from robocomp_dsl.runtime.component.naming import ANY, distance, nearest, on_same_branch
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.errors import AmbiguousServer, NoServer
from robocomp_dsl.runtime.middleware.base import Endpoint, OperationCallable

DISCOVERY_TIMEOUT_S = 1.0
"""After the start of a component, its calls wait this long for a server to appear."""

log = logging.getLogger("robocomp")
_T = TypeVar("_T")
_RUNTIME = str(Path(__file__).parents[1])
_STANDARD_LIBRARY = str(Path(os.__file__).parent)


def matches(at: Endpoint, component: str, port: str) -> bool:
    """Whether `at` is connected to this port, or may discover it."""
    wired = at.peers
    if component in wired or f"{component}.{port}" in wired:
        return True
    return (not wired or f"{ANY}.{port}" in wired) and on_same_branch(at.component, component)


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
    if not candidates:
        subject = f"{' or '.join(at.peers)} does not serve" if at.peers else "no component serves"
        raise NoServer(f"{subject} {interface}, which {at.component} requires as {at.port}")
    listed = ", ".join(sorted(candidates))
    # In a namespace, the suggested name must be absolute.
    first = f"{'/' if '/' in at.component else ''}{min(candidates).partition('.')[0]}"
    raise AmbiguousServer(
        f"{listed} all serve {interface}, which {at.component} requires as {at.port};"
        f" select one: --connect {at.port}={first}",
        tuple(sorted(candidates)),
    )


def with_deadline_check(
    handler: OperationCallable, deadline: float, counts: OperationCounts
) -> OperationCallable:
    """`handler`, counting publications more than `deadline` s after the previous one."""
    last = 0.0

    def watch(*arguments: Any) -> Any:
        nonlocal last
        now = time.monotonic()
        if last and now - last > deadline:
            counts.missed += 1
        last = now
        return handler(*arguments)

    return watch


def log_failure(what: str, error: BaseException) -> None:
    """Log an exception of user code with its location; the traceback at level debug."""
    log.error("%s failed: %s", what, describe_error(error))
    log.debug("traceback of the failure of %s", what, exc_info=error)


def describe_error(error: BaseException) -> str:
    """`Type: message (file:line)`, with the innermost location in user code."""
    location = user_location(traceback.extract_tb(error.__traceback__))
    message = message_of(error)
    text = f"{type(error).__name__}: {message}" if message else type(error).__name__
    return f"{text} ({location})" if location else text


def user_location(frames: traceback.StackSummary) -> str:
    """`file:line` of the innermost frame in user code, or else of the innermost; "" without any."""
    own = [frame for frame in frames if not is_library_code(frame.filename)] or frames
    return f"{own[-1].filename}:{own[-1].lineno}" if own else ""


def message_of(error: BaseException) -> str:
    """`str(error)`; a `__str__` of user code that raises itself counts as no message."""
    try:
        return str(error)
    except Exception:
        return ""


def is_library_code(file: str) -> bool:
    """Whether a file is not user code: Python, the runtime, compiled codecs, generated code."""
    if file.startswith(_STANDARD_LIBRARY) and "site-packages" not in file:
        return True
    return file.startswith((_RUNTIME, "<")) or Path(file).parent.name.endswith("_generated")

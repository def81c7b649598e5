"""What all middlewares do alike: choose the peer of a call, and log what a handler raised.

In: endpoints and candidates. Out: one peer, or the failure that says why there is none.
"""

from __future__ import annotations

import logging
import time
import traceback
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from robocomp_dsl.runtime.errors import AmbiguousServer, NoServer
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint
from robocomp_dsl.runtime.naming import ANY, distance, nearest, related
from robocomp_dsl.runtime.statistics import OperationCounts

GRACE_S = 1.0
"""So long after the start of a component its calls wait for a server that is not there yet."""

log = logging.getLogger("robocomp")
_T = TypeVar("_T")
_RUNTIME = str(Path(__file__).parents[1])


def reaches(at: Endpoint, component: str, port: str) -> bool:
    """Whether this port is one that `at` is wired to, or may find where it is not wired."""
    wired = at.peers
    if component in wired or f"{component}.{port}" in wired:
        return True
    return (not wired or f"{ANY}.{port}" in wired) and related(at.component, component)


def servers(at: Endpoint, found: Sequence[_T], name: Callable[[_T], str]) -> list[_T]:
    """Those of `found` that count: all a wire names, else the nearest."""
    return list(found) if _named(at) else nearest(at.component, found, name)


def settled(at: Endpoint, components: Iterable[str]) -> bool:
    """Whether there is no reason to wait for a nearer server than these.

    A set of components under a prefix starts together: what is found around it first is not to be
    taken for the one beside that comes a moment later.
    """
    if _named(at):
        return any(True for _ in components)
    return any(distance(at.component, one) == 0 for one in components)


def _named(at: Endpoint) -> bool:
    return any(not one.startswith(f"{ANY}.") for one in at.peers)


def pick(at: Endpoint, candidates: Sequence[str]) -> str:
    """The one candidate (`component.port`). Raises `NoServer` or `AmbiguousServer`."""
    if len(candidates) == 1:
        return candidates[0]
    interface = at.interface.name
    if not candidates:
        whom = f"{' or '.join(at.peers)} does not serve" if at.peers else "nobody serves"
        raise NoServer(f"{whom} {interface}, which {at.component} requires as {at.port}")
    listed = ", ".join(sorted(candidates))
    # A name under a prefix has to be said whole.
    first = f"{'/' if '/' in at.component else ''}{min(candidates).partition('.')[0]}"
    raise AmbiguousServer(
        f"{listed} all serve {interface}, which {at.component} requires as {at.port};"
        f" say which: --connect {at.port}={first}",
        tuple(sorted(candidates)),
    )


def watched(handler: Bound, deadline: float, counts: OperationCounts) -> Bound:
    """`handler`, with the publications counted that come more than `deadline` s after the last."""
    last = 0.0

    def watch(*arguments: Any) -> Any:
        nonlocal last
        now = time.monotonic()
        if last and now - last > deadline:
            counts.missed += 1
        last = now
        return handler(*arguments)

    return watch


def log_failure(what: str, error: Exception) -> None:
    """Log an exception of user code: where it happened, what it says; the trace for debugging."""
    log.error("%s failed: %s", what, describe(error))
    log.debug("the whole trace of the failure of %s", what, exc_info=error)


def describe(error: BaseException) -> str:
    """`Type: message (file:line)`, the place being the last one in the user's own code."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [f for f in frames if not _is_ours(f.filename)] or frames
    said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    return f"{said} ({own[-1].filename}:{own[-1].lineno})" if own else said


def _is_ours(file: str) -> bool:
    """Whether no user wrote it: the runtime, what it compiles, what rcgen generates."""
    return file.startswith((_RUNTIME, "<")) or Path(file).parent.name == "generated"

"""What all middlewares do alike: choose the peer of a call, and log what a handler raised.

In: endpoints and candidates. Out: one peer, or the failure that says why there is none.
"""

from __future__ import annotations

import logging
import time
import traceback
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime.errors import AmbiguousServer, NoServer
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint
from robocomp_dsl.runtime.statistics import OperationCounts

GRACE_S = 1.0
"""So long after the start of a component its calls wait for a server that is not there yet."""

log = logging.getLogger("robocomp")
_RUNTIME = str(Path(__file__).parents[1])


def reaches(peers: Iterable[str], component: str, port: str) -> bool:
    """Whether a wire to `peers` leads to this port; no peers: to any."""
    wired = tuple(peers)
    return not wired or component in wired or f"{component}.{port}" in wired


def pick(at: Endpoint, candidates: Sequence[str]) -> str:
    """The one candidate (`component.port`). Raises `NoServer` or `AmbiguousServer`."""
    if len(candidates) == 1:
        return candidates[0]
    interface = at.interface.name
    if not candidates:
        whom = f"{' or '.join(at.peers)} does not serve" if at.peers else "nobody serves"
        raise NoServer(f"{whom} {interface}, which {at.component} requires as {at.port}")
    listed = ", ".join(sorted(candidates))
    first = min(candidates).split(".")[0]
    raise AmbiguousServer(
        f"{listed} all serve {interface}, which {at.component} requires as {at.port};"
        f" say which: --connect {at.port}={first}"
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

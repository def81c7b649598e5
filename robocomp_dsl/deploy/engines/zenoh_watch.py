"""The watch of deployments on zenoh: liveliness tokens that say component, pid and state.

In: a domain. Out: every change of state, as it happens; the death of a process within milliseconds.
"""

from __future__ import annotations

import threading

import zenoh

from robocomp_dsl.deploy.engines.watch import Seen
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.discovery import open_session


class ZenohWatch:
    """A session that only looks on. Raises `MiddlewareError` when it cannot be opened."""

    def __init__(self, domain: str) -> None:
        self._domain = domain
        self._states: dict[tuple[str, int], str] = {}
        self._lock = threading.Lock()
        self._opened = open_session(domain)

    def start(self, seen: Seen) -> None:
        """See `Watch`."""
        self._seen = seen
        self._subscriber = self._opened.session.liveliness().declare_subscriber(
            f"{keys.root(self._domain)}/s/**", self._hear, history=True
        )

    def _hear(self, sample: zenoh.Sample) -> None:
        found = keys.parse_state(str(sample.key_expr))
        if found is None:
            return
        name, pid, state = found
        with self._lock:
            if sample.kind != zenoh.SampleKind.DELETE:
                self._states[name, pid] = state
            elif self._states.get((name, pid)) == state:
                del self._states[name, pid]
                state = ""
            else:  # the end of a state that a newer one has followed
                return
            self._seen(name, pid, state)

    def close(self) -> None:
        """See `Watch`."""
        self._opened.close()

"""Follows the components of a domain from outside: who is alive, and in which state.

In: a domain. Out: calls as states change, each told by a liveliness token; nobody polls.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import zenoh

from robocomp_dsl.runtime.middleware.zenoh.discovery import open_session
from robocomp_dsl.runtime.middleware.zenoh.keys import parse_state, root

Seen: TypeAlias = Callable[[str, int, str], None]
"""`seen(name, pid, state)`; an empty state: no longer alive. Called from any thread."""


class Watch:
    """A look at one domain. Raises `MiddlewareError` when it cannot be entered."""

    def __init__(self, domain: str) -> None:
        self._domain = domain
        self._opened = open_session(domain)
        self._states: dict[tuple[str, int], str] = {}
        self._seen: Seen | None = None

    def start(self, seen: Seen) -> None:
        """Begin; what is alive already is told, too."""
        self._seen = seen
        self._subscriber = self._opened.session.liveliness().declare_subscriber(
            f"{root(self._domain)}/s/**", self._hear, history=True
        )

    def _hear(self, sample: zenoh.Sample) -> None:
        said = parse_state(str(sample.key_expr))
        if said is None or self._seen is None:
            return
        name, pid, state = said
        if sample.kind != zenoh.SampleKind.DELETE:
            self._states[name, pid] = state
            self._seen(name, pid, state)
        # The end of a state is news only when no other has followed it.
        elif self._states.get((name, pid)) == state:
            del self._states[name, pid]
            self._seen(name, pid, "")

    def close(self) -> None:
        """End; nothing is told afterwards."""
        self._seen = None
        self._opened.close()

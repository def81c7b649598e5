"""Monitors the components of a domain: which are alive, and in which state.

In: a domain. Out: a callback for each state change, from liveliness tokens; there is no polling.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import zenoh

from robocomp_dsl.runtime.presence.domain_session import open_session
from robocomp_dsl.runtime.presence.keys import domain_prefix, parse_state

StateCallback: TypeAlias = Callable[[str, int, str], None]
"""`on_state_changed(name, pid, state)`; an empty state: no longer alive. Called from any thread."""


class StateMonitor:
    """Monitors one domain. Raises `MiddlewareError` if no session can be opened."""

    def __init__(self, domain: str) -> None:
        self._domain = domain
        self._opened = open_session(domain)
        self._states: dict[tuple[str, int], str] = {}
        self._on_state_changed: StateCallback | None = None

    @property
    def session(self) -> zenoh.Session:
        """The session of the monitor."""
        return self._opened.session

    def start(self, on_state_changed: StateCallback) -> None:
        """Start monitoring. Reports the components that are already alive first."""
        self._on_state_changed = on_state_changed
        self._opened.watch_tokens(f"{domain_prefix(self._domain)}/s/**", self._on_token)

    def _on_token(self, key: str, exists: bool) -> None:
        token = parse_state(key)
        if token is None or self._on_state_changed is None:
            return
        name, pid, state = token
        if exists:
            self._states[name, pid] = state
            self._on_state_changed(name, pid, state)
        # The end of a state is reported only if no newer state has replaced it.
        elif self._states.get((name, pid)) == state:
            del self._states[name, pid]
            self._on_state_changed(name, pid, "")

    def close(self) -> None:
        """Stop monitoring; no callback follows."""
        self._on_state_changed = None
        self._opened.close()

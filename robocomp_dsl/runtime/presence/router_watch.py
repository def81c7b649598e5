"""Tells the end of a component from that of a router: only the first takes tokens away for good.

In: the session of a client, and the tokens that it watches. Out: a callback when a token appears,
and when it is lost. When a router dies, zenoh reports the tokens of all components behind it as
lost, although they still run. Such tokens are held until the router is back and had time to see its
components again.

- The router of this host is away: its tokens are held for as long as it is.
- The router of another host is away: its components are lost after `HOLD_S`, because the whole host
  may be down.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from typing import Any, TypeAlias

import zenoh

from robocomp_dsl.runtime.presence.keys import ROUTER_KEY

log = logging.getLogger("robocomp")
WINDOW_S = 0.03
"""The loss of a router and those of the tokens behind it are reported within this time."""
SETTLE_S = 2.0
"""After so long all components have connected again to a router that is back."""
HOLD_S = 5.0
"""The router of another host may be away so long before its components count as lost."""

TokenCallback: TypeAlias = Callable[[str, bool], None]
"""`on_token(key, exists)`. Called by one thread, in the order of events; a token that exists may be
reported again."""
OutageCallback: TypeAlias = Callable[[str], None]
"""`on_outage(text)`: `text` says that the router of this host is away; empty: a router is back."""


@dataclass(slots=True)
class _LostToken:
    """A token that zenoh reported as lost; `due`: when that is decided."""

    reported: float
    due: float
    is_held: bool = False


@dataclass(slots=True)
class _Watched:
    """The tokens of one key expression."""

    on_token: TokenCallback
    present: set[str] = field(default_factory=set)
    lost: dict[str, _LostToken] = field(default_factory=dict)


class RouterWatch:
    """Watches the routers and the tokens of one session, in a thread."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._events: SimpleQueue[tuple[Any, ...]] = SimpleQueue()
        self._watched: list[_Watched] = []
        self._declared: list[Any] = []
        self._away: set[str] = set()
        self._connected = True
        self._latest_loss = self._logged_loss = -math.inf
        self._on_outage: list[OutageCallback] = []
        self._thread = threading.Thread(target=self._run, name="robocomp.routers", daemon=True)
        self._thread.start()
        listen = session.info.declare_transport_events_listener
        self._declared.append(listen(_direct(self._on_transport), history=True))
        self._declare(f"{ROUTER_KEY}/*", self._on_router)

    def watch(self, key: str, on_token: TokenCallback) -> None:
        """Report the tokens of a key expression, those that exist first."""
        watched = _Watched(on_token)
        self._watched.append(watched)
        self._declare(key, lambda sample: self._events.put((self._token, watched, *_state(sample))))

    def on_outage(self, callback: OutageCallback) -> None:
        """Call `callback` when the router of this host is away, and when a router is back."""
        self._on_outage.append(callback)

    def _declare(self, key: str, callback: Callable[[zenoh.Sample], None]) -> None:
        declare = self._session.liveliness().declare_subscriber
        self._declared.append(declare(key, _direct(callback), history=True))

    def _on_transport(self, event: zenoh.TransportEvent) -> None:
        if event.transport.whatami == zenoh.WhatAmI.ROUTER:
            is_open = event.kind == zenoh.SampleKind.PUT
            self._events.put((self._own_router, is_open, time.monotonic()))

    def _on_router(self, sample: zenoh.Sample) -> None:
        self._events.put((self._other_router, *_state(sample)))

    def _run(self) -> None:
        """The thread: handle events in order, and lost tokens when they are due."""
        while True:
            due = min((t.due for each in self._watched for t in each.lost.values()), default=None)
            timeout = None if due in (None, math.inf) else max(0.0, due - time.monotonic())
            try:
                handle, *arguments = self._events.get(timeout=timeout)
            except Empty:
                self._check_due(time.monotonic())
                continue
            if handle is None:
                return
            handle(*arguments)

    def _token(self, watched: _Watched, key: str, exists: bool, at: float) -> None:
        if not exists:
            if key in watched.present:
                watched.lost.setdefault(key, _LostToken(at, at + WINDOW_S))
            return
        # A token that was held may stand for a newer state: it is reported again.
        if watched.lost.pop(key, None) or key not in watched.present:
            watched.present.add(key)
            watched.on_token(key, True)

    def _own_router(self, connected: bool, at: float) -> None:
        changed = connected != self._connected
        self._connected = connected
        if not connected:
            self._latest_loss = at
            if changed:
                self._report("the router of this host is away")
        elif changed:
            self._router_is_back(at)

    def _other_router(self, key: str, exists: bool, at: float) -> None:
        name = key.rpartition("/")[2]
        if not exists:
            self._latest_loss = max(self._latest_loss, at)
            self._away.add(name)
        elif name in self._away:
            self._away.discard(name)
            self._router_is_back(at)

    def _router_is_back(self, at: float) -> None:
        """Tokens that are held get some time to appear again."""
        for watched in self._watched:
            for token in watched.lost.values():
                if token.is_held:
                    token.due = at + SETTLE_S
        if self._connected:
            self._report("")

    def _report(self, outage: str) -> None:
        for callback in self._on_outage:
            callback(outage)

    def _check_due(self, now: float) -> None:
        for watched in self._watched:
            for key, token in list(watched.lost.items()):
                if token.due <= now and not self._holds(token):
                    del watched.lost[key]
                    watched.present.discard(key)
                    watched.on_token(key, False)

    def _holds(self, token: _LostToken) -> bool:
        """Whether a token that is due is held because a router is, or was, away."""
        if not self._connected:
            token.is_held, token.due = True, math.inf
            return True
        if not token.is_held and self._latest_loss >= token.reported - WINDOW_S:
            token.is_held, token.due = True, self._latest_loss + HOLD_S
            if self._logged_loss != self._latest_loss:
                self._logged_loss = self._latest_loss
                names = ", ".join(sorted(self._away)) or "a router"
                log.warning("%s is away; its components count as lost in %g s", names, HOLD_S)
            return True
        return False

    def close(self) -> None:
        """End the thread; no callback follows."""
        self._events.put((None,))
        if self._thread is not threading.current_thread():
            self._thread.join(1.0)


def _direct(callback: Callable[[Any], None]) -> Any:
    """A callback that zenoh calls in its own thread."""
    return zenoh.handlers.Callback(callback, indirect=False)


def _state(sample: zenoh.Sample) -> tuple[str, bool, float]:
    """Key of a token, whether it exists, and when that became known."""
    exists = sample.kind != zenoh.SampleKind.DELETE
    return str(sample.key_expr), exists, time.monotonic()

"""Which publishers of one subscription are alive.

In: records that the presence sees, messages, and replies to probes. Out: `publisher_alive` and
`publisher_lost`. A publisher is lost when its port disappears, or without a sign of life for the
time of `liveliness`: neither a message nor a reply.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from robocomp_dsl.runtime.presence.port_record import PortRecord

_CHECKS = 4
"""Checks within one time of `liveliness`."""


@dataclass(slots=True)
class _Publisher:
    latest_sign: float
    alive: bool = True
    probed: float = 0.0


class PublisherWatch:
    """The publishers of one subscription.

    `on_changed(publisher, alive)`; `probe(component, timeout, on_reply)` asks for a sign of life.
    """

    def __init__(
        self,
        liveliness: float,
        probe: Callable[[str, float, Callable[[], None]], None],
        on_changed: Callable[[str, bool], None],
    ) -> None:
        self.liveliness = liveliness
        self._probe = probe
        self._on_changed = on_changed
        self._publishers: dict[str, _Publisher] = {}
        self._lock = threading.Lock()

    def update(self, records: Iterable[PortRecord], now: float) -> None:
        """The publishers that exist now."""
        if not self.liveliness:
            return
        names = dict.fromkeys(record.name for record in records)
        with self._lock:
            lost = [n for n, p in self._publishers.items() if n not in names and p.alive]
            appeared = [name for name in names if name not in self._publishers]
            self._publishers = {
                name: self._publishers.get(name) or _Publisher(now) for name in names
            }
        for name in lost:
            self._on_changed(name, False)
        for name in appeared:
            self._on_changed(name, True)

    def check(self, now: float, latest_message: float) -> float:
        """Probe silent publishers and report lost publishers; returns when to check again."""
        if not self.liveliness or not self._publishers:
            return math.inf
        with self._lock:
            if len(self._publishers) == 1:  # the message came from it
                only = next(iter(self._publishers.values()))
                only.latest_sign = max(only.latest_sign, latest_message)
            publishers = list(self._publishers.items())
        for name, publisher in publishers:
            if now - publisher.latest_sign > self.liveliness / 2:
                self._check_silent(name, publisher, now)
            elif not publisher.alive:
                publisher.alive = True
                self._on_changed(name, True)
        return now + self.liveliness / _CHECKS

    def _check_silent(self, name: str, publisher: _Publisher, now: float) -> None:
        if publisher.alive and now - publisher.latest_sign > self.liveliness:
            publisher.alive = False
            self._on_changed(name, False)
        if now - publisher.probed >= self.liveliness / 2:
            publisher.probed = now
            component = name.rpartition(".")[0]
            self._probe(component, self.liveliness / 2, lambda: self._replied(name))

    def _replied(self, name: str) -> None:
        """A reply to a probe has arrived."""
        with self._lock:
            publisher = self._publishers.get(name)
            if publisher is None:
                return
            publisher.latest_sign = time.monotonic()
            revived = not publisher.alive
            publisher.alive = True
        if revived:
            self._on_changed(name, True)

"""The events of one input: set by monitors, each for a lifetime.

In: names and lifetimes. Out: the events that are active at a moment of the component's clock.
"""

from __future__ import annotations

import math
from typing import Protocol

from robocomp_dsl.monitors.constraint import EVENT_NAME


class EventClock(Protocol):
    """What the container needs of a component's clock."""

    @property
    def reset_count(self) -> int:
        """How often time was reset; -1: the clock has not started."""

    def now(self) -> float:
        """Seconds since a fixed moment."""


class EventContainer:
    """Events, and when they expire. An event is active before its expiry, not at it.

    After a reset of a simulated clock, events with a lifetime are gone.
    """

    def __init__(self, clock: EventClock) -> None:
        self._clock = clock
        self._reset_count = clock.reset_count
        self._expiries: dict[str, float] = {}

    def set(self, event: str, lifetime: float | None = None) -> None:
        """Set an event for `lifetime` s, or until `unset`. Raises `ValueError`."""
        if not isinstance(event, str) or not EVENT_NAME.fullmatch(event):
            raise ValueError(f"{event!r} is not the name of an event; write a name such as e_face")
        if lifetime is None:
            self._expiries[event] = math.inf
            return
        if not isinstance(lifetime, int | float) or not lifetime > 0:
            raise ValueError(f"the lifetime of {event} is a time above 0 s, not {lifetime!r}")
        self._expiries[event] = self._now() + lifetime

    def unset(self, event: str) -> None:
        """Remove an event if it is set."""
        self._expiries.pop(event, None)

    def active(self) -> frozenset[str]:
        """The events whose lifetime has not ended."""
        if not self._expiries:
            return frozenset()
        now = self._now()
        return frozenset(event for event, expiry in self._expiries.copy().items() if now < expiry)

    def remaining(self) -> tuple[tuple[str, float], ...]:
        """The active events, sorted, and their remaining time in s; infinity: until unset."""
        now = self._now()
        items = sorted(self._expiries.copy().items())
        return tuple((event, expiry - now) for event, expiry in items if now < expiry)

    def _now(self) -> float:
        """The time; events of the time before a reset are removed."""
        count = self._clock.reset_count
        if count != self._reset_count:
            if self._reset_count >= 0:  # the clock had started
                permanent = {e: t for e, t in self._expiries.items() if t == math.inf}
                self._expiries = permanent
            self._reset_count = count
        return self._clock.now()

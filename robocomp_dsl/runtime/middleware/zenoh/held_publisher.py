"""A publisher that reliable subscribers may hold for a limited time.

In: a zenoh publisher whose session waits `HOLD_S` before it drops a message. Out: `put`, which
returns after that time at the latest, and counts and logs what it could not deliver. After one such
wait zenoh drops further messages without waiting until the subscriber receives again; subscribers
count those.
"""

from __future__ import annotations

import logging
from time import perf_counter_ns

import zenoh

from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle

HOLD_S = 1.0
"""How long subscribers may hold a publication."""
_HELD_NS = round(0.9 * HOLD_S * NANO)
_HELD = "a subscriber that receives nothing held %s.%s for %.1f s; until it does, it loses messages"
log = logging.getLogger("robocomp")


class HeldPublisher:
    """Has the `put` of a zenoh publisher; `counts` are those of its operation."""

    __slots__ = ("_counts", "_put", "_throttle")

    def __init__(self, publisher: zenoh.Publisher, counts: OperationCounts) -> None:
        self._put = publisher.put
        self._counts = counts
        self._throttle = Throttle()

    def put(self, payload: bytes, attachment: bytes | None = None) -> None:
        """Publish; returns within `HOLD_S`."""
        begun = perf_counter_ns()
        self._put(payload, attachment=attachment)
        took = perf_counter_ns() - begun
        if took > _HELD_NS:
            self._counts.drops += 1
            if self._throttle.allows("held"):
                log.warning(_HELD, self._counts.port, self._counts.operation, took / NANO)

"""When outputs with a rate are due, on the clock of the component.

All outputs share one period: the greatest one of which each output's period is a multiple. Missed
messages are skipped, so that outputs keep their phase.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction

MIN_PERIOD_MS = 1.0
"""Outputs whose rates have no longer common period share this one."""


def common_period_ms(rates: Mapping[str, float]) -> float:
    """The period in ms in which all outputs are due at whole numbers of it; 0.0 without rates."""
    periods = [1 / Fraction(rate).limit_denominator(1000) for rate in rates.values() if rate > 0]
    if not periods:
        return 0.0
    numerator = math.gcd(
        *(
            p.numerator * math.lcm(*(q.denominator for q in periods)) // p.denominator
            for p in periods
        )
    )
    common = Fraction(numerator, math.lcm(*(p.denominator for p in periods)))
    return max(float(common) * 1000, min(MIN_PERIOD_MS, *(float(p) * 1000 for p in periods)))


class RateSchedule:
    """The moments at which outputs are due; `rates` in Hz by name, 0: not by time."""

    def __init__(self, rates: Mapping[str, float]) -> None:
        self.rates = dict(rates)
        self._due: dict[str, float] = {}
        self._last = -math.inf

    @property
    def period_ms(self) -> float:
        """See `common_period_ms`."""
        return common_period_ms(self.rates)

    def set_rate(self, name: str, rate: float) -> None:
        """Change the rate of an output in Hz; it is due at once."""
        self.rates[name] = rate
        self._due.pop(name, None)

    def due(self, now: float) -> list[str]:
        """The outputs that are due at `now` in s; after a clock jump back, all of them."""
        if now < self._last:
            self._due.clear()
        self._last = now
        # A cycle that starts a little early still counts: sums of periods are rounded.
        early = self.period_ms / 10_000
        found = []
        for name, rate in self.rates.items():
            if rate <= 0:
                continue
            due = self._due.get(name, now)
            if now + early < due:
                continue
            found.append(name)
            period = 1 / rate
            skipped = max(math.floor((now + early - due) / period), 0)
            self._due[name] = due + (skipped + 1) * period
        return found

"""How far the clock of a host is from that of this machine.

As NTP does (RFC 5905, section 8): the host reports its time t1 for a request of t0 whose reply
arrives at t2; the offset of its clock is t1 - (t0 + t2) / 2, with an error of at most half the
round trip. The exchange with the shortest round trip counts.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from robocomp_dsl.deploy.hosts.connection import HostProcess

ROUNDS = 8
NS_PER_S = 1e9


@dataclass(frozen=True, slots=True)
class ClockOffset:
    """`offset_s` is positive if the clock is ahead; its error is at most `uncertainty_s` [s]."""

    offset_s: float
    uncertainty_s: float

    def exceeds(self, limit_s: float) -> bool:
        """Whether the offset is certainly larger than `limit_s`."""
        return abs(self.offset_s) - self.uncertainty_s > limit_s

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self)

    def format(self) -> str:
        """As text: `+1.2 ± 0.3 ms`, `-3600.0 s`."""
        if abs(self.offset_s) >= 1.0:
            return f"{self.offset_s:+.1f} ± {self.uncertainty_s:.1f} s"
        return f"{self.offset_s * 1e3:+.1f} ± {self.uncertainty_s * 1e3:.1f} ms"


@dataclass(frozen=True, slots=True)
class TimeExchange:
    """One request: `sent` and `received` by the clock here, `remote` by that of the host [ns]."""

    sent: int
    remote: int
    received: int


def best_offset(exchanges: Iterable[TimeExchange]) -> ClockOffset:
    """The offset of the exchange with the shortest round trip."""
    best = min(exchanges, key=lambda exchange: exchange.received - exchange.sent)
    offset = best.remote - (best.sent + best.received) / 2
    return ClockOffset(offset / NS_PER_S, (best.received - best.sent) / 2 / NS_PER_S)


async def measure_offset(process: HostProcess, rounds: int = ROUNDS) -> ClockOffset:
    """Ask `fact_script.py` for its time. Raises `HostError`, and `ValueError` for other replies."""
    exchanges = []
    for _ in range(rounds):
        begin, sent = time.monotonic_ns(), time.time_ns()
        await process.write(b"\n")
        remote = int(await process.readline())
        received = sent + time.monotonic_ns() - begin  # also if the clock here is set meanwhile
        exchanges.append(TimeExchange(sent, remote, received))
    return best_offset(exchanges)

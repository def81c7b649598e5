"""The load of a host, and the score by which `place by load` compares hosts. Pure.

The formula is that of yarpmanager, `KnowledgeBase::calculateLoad` in
`src/libYARP_manager/src/yarp/manager/kbase.cpp` of YARP: a weighted mean of the three load
averages, divided by the number of logical CPUs,

    score = (15 * load1 + 10 * load5 + 1 * load15) / 26 / cpus.

`KnowledgeBase::reason` in the same file chooses the provider with the lowest weight, the first one
among equals, and then adds 1 / cpus to its weight, because a component that was just placed does
not show in the load averages yet. (With a `<rank>` of 10 or more yarpmanager adds rank / 100
instead; DDSL has no ranks.)
"""

from __future__ import annotations

import os
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class HostLoad:
    """The load averages of a host over 1, 5 and 15 minutes (getloadavg(3)), and its logical CPUs.

    `cpus` below 1 counts as 1, as in yarpmanager.
    """

    load1: float
    load5: float
    load15: float
    cpus: int

    @property
    def score(self) -> float:
        """The score without components that are yet to be started; lower is better."""
        mean = (15 * self.load1 + 10 * self.load5 + self.load15) / 26
        return mean / max(1, self.cpus)

    @property
    def score_of_component(self) -> float:
        """What one more component adds to the score."""
        return 1 / max(1, self.cpus)


def local_load() -> HostLoad:
    """The load of this machine."""
    return HostLoad(*os.getloadavg(), os.cpu_count() or 1)

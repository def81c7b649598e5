"""wander: looks at the laser and drives the base, and waits where one of them is away."""

from __future__ import annotations

import logging
import random
import time

from generated.genericworker import GenericWorker
from reaction import Turning, decide

from robocomp_dsl.runtime.errors import MiddlewareError

log = logging.getLogger("wander")


class SpecificWorker(GenericWorker):
    """Drives about without hitting anything."""

    def initialize(self) -> None:
        """Begin by going ahead."""
        self.chance = random.Random(self.params.seed)  # noqa: S311 - no secret
        self.turning: Turning | None = None
        self.away = False

    def compute(self) -> None:
        """Look, decide, drive."""
        try:
            self.step()
        except MiddlewareError as error:
            if not self.away:
                log.warning("waiting for the robot: %s", error)
            self.away = True
        else:
            if self.away:
                log.info("the robot is back")
            self.away = False

    def step(self) -> None:
        """One look and one command."""
        scan = self.laser_proxy.getLaserData()
        now = time.monotonic()
        found = decide(scan.angle, scan.dist, now, self.turning, it=self.params, chance=self.chance)
        if found.turning is not None and self.turning is None:
            side = "right" if found.turning.sense > 0 else "left"
            log.info("something at %.0f mm, turning %s", found.nearest, side)
        self.turning = found.turning
        self.differentialrobot_proxy.setSpeedBase(found.adv, found.rot)

    def finalize(self) -> None:
        """Leave no robot driving."""
        try:
            self.differentialrobot_proxy.stopBase()
        except MiddlewareError as error:
            log.info("the robot could not be stopped, it is away: %s", error)

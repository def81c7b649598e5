"""wander: reads the laser and drives the base."""

from __future__ import annotations

import random

from reaction import Turning, decide
from wander_generated.genericworker import GenericWorker

from robocomp_dsl.runtime.errors import MiddlewareError


class SpecificWorker(GenericWorker):
    """Drives around without collisions.

    While the robot is missing a call raises; the lifecycle logs it and retries.
    """

    def initialize(self) -> None:
        """Start by driving ahead."""
        self.chance = random.Random(self.params.seed)  # noqa: S311 - no secret
        self.turning: Turning | None = None
        self.epoch = self.clock.reset_count

    def compute(self) -> None:
        """Read a scan, decide, drive."""
        scan = self.laser_proxy.getLaserData()
        now = self.clock.now()
        if self.clock.reset_count != self.epoch:
            self.epoch, self.turning = self.clock.reset_count, None
        found = decide(scan.angle, scan.dist, now, self.turning, it=self.params, chance=self.chance)
        if found.turning is not None and self.turning is None:
            side = "right" if found.turning.sense > 0 else "left"
            self.log.info("something at %.0f mm, turning %s", found.nearest, side)
        self.turning = found.turning
        self.differentialrobot_proxy.setSpeedBase(found.adv, found.rot)

    def finalize(self) -> None:
        """Stop the robot."""
        try:
            self.differentialrobot_proxy.stopBase()
        except MiddlewareError as error:
            self.log.info("the robot could not be stopped, it is away: %s", error)

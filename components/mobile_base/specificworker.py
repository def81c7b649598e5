"""mobile_base: a MuJoCo world that follows a clock or is its source, and serves its devices."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from mobile_base_generated.genericworker import GenericWorker
from mobile_base_generated.interfaces import (
    HardwareFailedException,
    LaserConfData,
    TBaseState,
    TLaserData,
)
from simulation import Simulation, simulate

from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose
from robocomp_dsl.hardware.servants.base import base_state_to_message
from robocomp_dsl.hardware.servants.laser import settings_to_message
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.runtime.time.clock_source import ClockSource

MOST_BEHIND = 0.1
"""Maximum seconds that one `compute` catches up; after a longer pause the process was suspended."""


class SpecificWorker(GenericWorker):
    """A simulated base with two driven wheels and a planar laser in a room."""

    simulation: Simulation

    def initialize(self) -> None:
        """Build the world."""
        self.will_set_speed(self.params.speed)
        self.begin()
        self.did_set_speed(self.params.speed)

    def begin(self) -> None:
        """Reset the world to the start."""
        self.simulation = simulate(self.params)
        self.last, self.epoch = self.clock.now(), max(self.clock.reset_count, 0)
        self.next_publication = 0.0

    def will_set_speed(self, value: float) -> None:
        """Reject speed 0 on the wall clock, which cannot run faster than real time."""
        if not value and not isinstance(self.clock, ClockSource):
            raise ParameterRejected(
                "0 is for deployments with `clock sim`, where this component is the clock"
            )

    def did_set_speed(self, _old: float) -> None:
        """Set the speed of the deployment's clock if this component is its source."""
        if isinstance(self.clock, ClockSource):
            self.clock.set_speed(self.params.speed)

    def compute(self) -> None:
        """Advance the world to the clock, and publish the state of the base."""
        if self.clock.reset_count != self.epoch:
            self.begin()
        now = self.clock.now()
        passed, self.last = now - self.last, now
        if isinstance(self.clock, ClockSource):
            if now - passed < self.params.hold_at <= now:
                self.clock.pause()
        else:
            passed = min(passed, MOST_BEHIND) * self.params.speed
        world = self.simulation.world
        world.advance(passed)
        if world.time >= self.next_publication:
            period = self.params.publish_period / 1000
            self.next_publication = max(self.next_publication + period, world.time)
            state = self.simulation.base.state()
            self.differentialrobotpub_proxy.pushBaseState(
                base_state_to_message(TBaseState, state), state.time
            )

    # implements RoboCompDifferentialRobot::DifferentialRobot

    def DifferentialRobot_getBaseState(self) -> TBaseState:
        """The whole state."""
        state: TBaseState = base_state_to_message(TBaseState, self.simulation.base.state())
        return state

    def DifferentialRobot_getBasePose(self) -> tuple[int, int, float]:
        """The odometry pose alone, in whole millimetres."""
        pose = self.simulation.base.state().odometry
        return round(pose.x), round(pose.z), pose.alpha

    def DifferentialRobot_setSpeedBase(self, adv: float, rot: float) -> None:
        """Drive; rejects numbers that are not finite or beyond the limits."""
        with _failures():
            self.simulation.base.set_speed(adv, rot)

    def DifferentialRobot_stopBase(self) -> None:
        """Stop as fast as possible."""
        self.simulation.base.stop()

    def DifferentialRobot_resetOdometer(self) -> None:
        """Reset the odometry to x = z = alpha = 0."""
        self.simulation.base.set_odometry(ORIGIN)

    def DifferentialRobot_setOdometer(self, state: TBaseState) -> None:
        """Set the odometry to the pose in `state`."""
        with _failures():
            self.simulation.base.set_odometry(Pose(state.x, state.z, state.alpha))

    def DifferentialRobot_setOdometerPose(self, x: int, z: int, alpha: float) -> None:
        """Set the odometry to this pose."""
        with _failures():
            self.simulation.base.set_odometry(Pose(x, z, alpha))

    def DifferentialRobot_correctOdometer(self, x: int, z: int, alpha: float) -> None:
        """Set the corrected pose."""
        with _failures():
            self.simulation.base.correct(Pose(x, z, alpha))

    # implements RoboCompLaser::Laser

    def Laser_getLaserData(self) -> TLaserData:
        """The latest scan."""
        scan = self.simulation.laser.scan()
        return TLaserData.from_columns(angle=scan.angles, dist=scan.distances)

    def Laser_getLaserAndBStateData(self) -> tuple[TLaserData, TBaseState]:
        """The latest scan, and the state of the base."""
        return self.Laser_getLaserData(), self.DifferentialRobot_getBaseState()

    def Laser_getLaserConfData(self) -> LaserConfData:
        """Configuration of the laser."""
        laser = self.simulation.laser
        message: LaserConfData = settings_to_message(LaserConfData, laser.name, laser.settings)
        return message


@contextmanager
def _failures() -> Iterator[None]:
    """Converts a device's rejection to the declared exception of its interface."""
    try:
        yield
    except HardwareError as error:
        raise HardwareFailedException(what=str(error)) from None

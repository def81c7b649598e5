"""`Simulation` over a simulated world: time, snapshots, and forks that run ahead."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, numbers
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.devices.errors import CommandRefused, HardwareError, require_finite
from robocomp_dsl.hardware.kinematics.rotations import angles
from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.hardware.servants.servant import Servant

MAX_SNAPSHOTS = 32
"""Maximum number of snapshots, and of forks."""

MAX_ADVANCE_S = 600.0
"""Maximum seconds that one call may advance a fork."""

MAX_STEPS = 100_000


@dataclass(frozen=True, slots=True)
class Fork:
    """A copy of the world, used by one thread at a time."""

    state: Any
    lock: FairLock = field(default_factory=FairLock)


class SimulationServant(Servant):
    """The device is the simulation; forks run independently of its time."""

    NEEDS_LOCK: ClassVar[bool] = False
    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = ((HardwareError, "Refused"),)

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._numbers = count(1)
        self._snapshots: dict[int, Any] = {}
        self._forks: dict[int, Fork] = {}

    # -- time ---------------------------------------------------------------------------------

    def getState(self) -> Any:
        """State of the simulation."""
        it = self.device()
        with it.lock:
            return self.types.State(
                time=it.time,
                speed=it.step_driver.speed,
                realTimeFactor=it.step_driver.real_time_factor,
                paused=it.step_driver.paused,
                physics=it.physics,
                seed=it.seed,
                noise=it.noise.factor,
                failure=it.failure,
            )

    def pause(self) -> None:
        """Pause time."""
        self.device().step_driver.pause()

    def resume(self) -> None:
        """Resume time."""
        self.device().step_driver.resume()

    def step(self, steps: int) -> float:
        """Run that many steps."""
        it = self.device()
        if not 0 <= steps <= MAX_STEPS:
            raise CommandRefused(f"`steps` is {steps}, it must be 0 to {MAX_STEPS}")
        if not it.step_driver.paused:
            raise CommandRefused("only a world that is paused goes step by step")
        it.raise_if_failed()
        it.step_driver.step(steps * it.dt)
        with it.lock:
            return float(it.time)

    def reset(self) -> None:
        """Reset to the start."""
        with self.device().lock:
            self.device().reset()

    def setSeed(self, seed: int) -> None:
        """Set the seed of the next reset."""
        if seed < 0:
            raise CommandRefused(f"`seed` is {seed}, it cannot be negative")
        self.device().seed = seed

    def setSpeed(self, speed: float) -> None:
        """Set the simulated seconds per second."""
        with self.device().lock:
            self.device().set_speed(speed)

    def setNoise(self, factor: float) -> None:
        """Set the factor on the declared noise."""
        with self.device().lock:
            self.device().noise.set(factor)

    def setPhysics(self, on: bool) -> None:
        """Enable or disable gravity and contacts."""
        with self.device().lock:
            self.device().set_physics(on)

    # -- snapshots ----------------------------------------------------------------------------

    def snapshot(self) -> int:
        """Save the state of the world."""
        return self._store(self._snapshots, self._fork())

    def restore(self, snapshot: int) -> None:
        """Restore a saved state."""
        state = self._lookup(self._snapshots, "snapshot", snapshot)
        it = self.device()
        with it.lock:
            it.restore(state.fork(shared=(it.noise, it.lock)))

    def forget(self, snapshot: int) -> None:
        """Delete a saved state."""
        self._lookup(self._snapshots, "snapshot", snapshot)
        del self._snapshots[snapshot]

    # -- forks --------------------------------------------------------------------------------

    def fork(self) -> int:
        """A fork that advances on request."""
        return self._store(self._forks, Fork(self._fork()))

    def advance(self, fork: int, seconds: float) -> float:
        """Advance a fork."""
        require_finite(seconds=seconds)
        if not 0 <= seconds <= MAX_ADVANCE_S:
            raise CommandRefused(f"`seconds` is {seconds:g}, it must be 0 to {MAX_ADVANCE_S:g}")
        it = self._lookup(self._forks, "fork", fork)
        with it.lock:
            it.state.world.advance(seconds)
            return float(it.state.world.time)

    def drive(self, fork: int, base: str, side: float, adv: float, rot: float) -> None:
        """Drive a base of a fork."""
        turns, branch = self._seen(fork)
        with turns:
            found = branch.devices.get(base)
            if not hasattr(found, "set_speed"):
                raise CommandRefused(f"there is no base `{base}`")
            found.set_speed(side, adv, rot)

    def move(self, fork: int, joints: Sequence[str], positions: Floats) -> None:
        """Move joints of a fork."""
        turns, branch = self._seen(fork)
        values = numbers("positions", positions, len(joints))
        with turns:
            for name, value in zip(joints, values.tolist(), strict=True):
                found = branch.devices.get(name)
                if not hasattr(found, "board"):
                    raise CommandRefused(f"there is no joint `{name}`")
                board = found.board
                joint = board.select.indices([name])
                unit = 1e-3 if board.spec.joints[joint[0]].prismatic else 1.0
                board.set_modes(joint, [Mode.POSITION])
                goal, _ = board.limits.clip(joint, np.array([value * unit]))
                board.references.move(joint, goal, board.dt, board.limits.speed[joint])

    def getPoses(self, fork: int, frames: Sequence[str]) -> Any:
        """Poses of frames."""
        turns, branch = self._seen(fork)
        with turns:
            matrices = [branch.matrix(name) for name in frames]
        poses = [(*m[:3, 3].tolist(), *angles(m[:3, :3])) for m in matrices]
        return self.types.Poses([self.types.Pose(*pose) for pose in poses])

    def getJoints(self, fork: int, joints: Sequence[str]) -> Floats:
        """Joint positions."""
        turns, branch = self._seen(fork)
        with turns:
            return np.array([branch.joint(name) for name in joints], dtype=np.float64)

    def release(self, fork: int) -> None:
        """Delete a fork."""
        self._lookup(self._forks, "fork", fork)
        del self._forks[fork]

    # -- viewers ------------------------------------------------------------------------------

    def getModel(self) -> Any:
        """The complete model."""
        it = self.device()
        with it.lock:
            data, revision = self._sight.to_mjb(it.world.model), it.revision
        return self.types.Model(self._sight.VERSION, revision, data)

    def getSight(self) -> Any:
        """Poses of all bodies."""
        it = self.device()
        with it.lock:
            seen = self._sight.capture(it.world.model, it.world.data)
            revision, time = it.revision, it.time
        return self.types.Sight(
            time=time,
            realTimeFactor=it.step_driver.real_time_factor,
            paused=it.step_driver.paused,
            revision=revision,
            positions=seen.positions,
            poses=seen.poses.ravel(),
            contacts=seen.contacts.ravel(),
        )

    # -- inside -------------------------------------------------------------------------------

    @property
    def _sight(self) -> Any:
        # Needs MuJoCo, unlike servants of real devices in the same table.
        from robocomp_dsl.simulation.world import visual_state  # noqa: PLC0415

        return visual_state

    def _fork(self) -> Any:
        it = self.device()
        with it.lock:
            return it.fork()

    def _seen(self, fork: int) -> tuple[FairLock, Any]:
        it = self._lookup(self._forks, "fork", fork) if fork else self.device()
        return it.lock, it.state

    def _store(self, store: dict[int, Any], entry: Any) -> int:
        if len(store) >= MAX_SNAPSHOTS:
            raise CommandRefused(f"{MAX_SNAPSHOTS} are kept already; let go of one first")
        number = next(self._numbers)
        store[number] = entry
        return number

    @staticmethod
    def _lookup(store: dict[int, Any], what: str, number: int) -> Any:
        if number not in store:
            raise CommandRefused(f"there is no {what} {number}")
        return store[number]

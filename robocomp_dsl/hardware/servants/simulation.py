"""`Simulation` over a simulated world: its time, what is kept of it, and copies that run ahead."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, numbers
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.errors import CommandRefused, HardwareError, finite
from robocomp_dsl.hardware.rotations import angles
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.hardware.turns import Turns

MOST_KEPT = 32
"""Snapshots, and forks, at a time."""

MOST_AHEAD = 600.0
"""Seconds that one call may let pass in a fork."""

MOST_STEPS = 100_000


@dataclass(frozen=True, slots=True)
class Fork:
    """A copy of the world, touched by one thread at a time."""

    branch: Any
    turns: Turns = field(default_factory=Turns)


class SimulationServant(Servant):
    """The device is the simulation; forks run beside it, so that its own time does not wait."""

    TAKES_TURNS: ClassVar[bool] = False
    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = ((HardwareError, "Refused"),)

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
        self._numbers = count(1)
        self._kept: dict[int, Any] = {}
        self._forks: dict[int, Fork] = {}

    # -- time ---------------------------------------------------------------------------------

    def getState(self) -> Any:
        """How it runs."""
        it = self.device()
        with it.turns:
            return self.types.State(
                time=it.time,
                speed=it.pace.speed,
                realTimeFactor=it.pace.factor,
                paused=it.pace.paused,
                physics=it.physics,
                seed=it.seed,
                noise=it.noise.factor,
                failure=it.failure,
            )

    def pause(self) -> None:
        """Time stands still."""
        self.device().pace.pause()

    def resume(self) -> None:
        """Time goes on."""
        self.device().pace.resume()

    def step(self, steps: int) -> float:
        """So many steps at once."""
        it = self.device()
        if not 0 <= steps <= MOST_STEPS:
            raise CommandRefused(f"`steps` is {steps}, it must be 0 to {MOST_STEPS}")
        if not it.pace.paused:
            raise CommandRefused("only a world that is paused goes step by step")
        it.judge()
        it.pace.step(steps * it.dt)
        with it.turns:
            return float(it.time)

    def reset(self) -> None:
        """As at the start."""
        with self.device().turns:
            self.device().reset()

    def setSeed(self, seed: int) -> None:
        """The seed of the next reset."""
        if seed < 0:
            raise CommandRefused(f"`seed` is {seed}, it cannot be negative")
        self.device().seed = seed

    def setSpeed(self, speed: float) -> None:
        """Simulated seconds per second."""
        with self.device().turns:
            self.device().set_speed(speed)

    def setNoise(self, factor: float) -> None:
        """A factor on the declared noise."""
        with self.device().turns:
            self.device().noise.set(factor)

    def setPhysics(self, on: bool) -> None:
        """Gravity and contacts, or neither."""
        with self.device().turns:
            self.device().set_physics(on)

    # -- the past -----------------------------------------------------------------------------

    def snapshot(self) -> int:
        """Keep the world."""
        return self._keep(self._kept, self._copy())

    def restore(self, snapshot: int) -> None:
        """Go back."""
        kept = self._found(self._kept, "snapshot", snapshot)
        it = self.device()
        with it.turns:
            it.restore(kept.copy(shared=(it.noise, it.turns)))

    def forget(self, snapshot: int) -> None:
        """Keep it no more."""
        self._found(self._kept, "snapshot", snapshot)
        del self._kept[snapshot]

    # -- possible futures ---------------------------------------------------------------------

    def fork(self) -> int:
        """A copy that runs when it is told to."""
        return self._keep(self._forks, Fork(self._copy()))

    def advance(self, fork: int, seconds: float) -> float:
        """Let time pass there."""
        finite(seconds=seconds)
        if not 0 <= seconds <= MOST_AHEAD:
            raise CommandRefused(f"`seconds` is {seconds:g}, it must be 0 to {MOST_AHEAD:g}")
        it = self._found(self._forks, "fork", fork)
        with it.turns:
            it.branch.world.advance(seconds)
            return float(it.branch.world.time)

    def drive(self, fork: int, base: str, side: float, adv: float, rot: float) -> None:
        """Drive a base there."""
        turns, branch = self._seen(fork)
        with turns:
            found = branch.devices.get(base)
            if not hasattr(found, "set_speed"):
                raise CommandRefused(f"there is no base `{base}`")
            found.set_speed(side, adv, rot)

    def move(self, fork: int, joints: Sequence[str], positions: Floats) -> None:
        """Move joints there."""
        turns, branch = self._seen(fork)
        values = numbers("positions", positions, len(joints))
        with turns:
            for name, value in zip(joints, values.tolist(), strict=True):
                found = branch.devices.get(name)
                if not hasattr(found, "board"):
                    raise CommandRefused(f"there is no joint `{name}`")
                board = found.board
                one = board.select.indices([name])
                unit = 1e-3 if board.spec.joints[one[0]].prismatic else 1.0
                board.set_modes(one, [Mode.POSITION])
                goal, _ = board.limits.clip(one, np.array([value * unit]))
                board.references.move(one, goal, board.dt, board.limits.speed[one])

    def getPoses(self, fork: int, frames: Sequence[str]) -> Any:
        """Where frames are."""
        turns, branch = self._seen(fork)
        with turns:
            matrices = [branch.matrix(name) for name in frames]
        poses = [(*m[:3, 3].tolist(), *angles(m[:3, :3])) for m in matrices]
        return self.types.Poses([self.types.Pose(*one) for one in poses])

    def getJoints(self, fork: int, joints: Sequence[str]) -> Floats:
        """Positions of joints."""
        turns, branch = self._seen(fork)
        with turns:
            return np.array([branch.joint(name) for name in joints], dtype=np.float64)

    def release(self, fork: int) -> None:
        """A fork goes."""
        self._found(self._forks, "fork", fork)
        del self._forks[fork]

    # -- to be looked at ----------------------------------------------------------------------

    def getModel(self) -> Any:
        """All that is simulated."""
        it = self.device()
        with it.turns:
            data, revision = self._sight.written(it.world.model), it.revision
        return self.types.Model(self._sight.VERSION, revision, data)

    def getSight(self) -> Any:
        """Where everything is."""
        it = self.device()
        with it.turns:
            seen = self._sight.seen(it.world.model, it.world.data)
            revision, time = it.revision, it.time
        return self.types.Sight(
            time=time,
            realTimeFactor=it.pace.factor,
            paused=it.pace.paused,
            revision=revision,
            positions=seen.positions,
            poses=seen.poses.ravel(),
            contacts=seen.contacts.ravel(),
        )

    # -- inside -------------------------------------------------------------------------------

    @property
    def _sight(self) -> Any:
        # Needs MuJoCo, which servants of real devices in the same table do not.
        from robocomp_dsl.hardware.mujoco import sight  # noqa: PLC0415

        return sight

    def _copy(self) -> Any:
        it = self.device()
        with it.turns:
            return it.copy()

    def _seen(self, fork: int) -> tuple[Turns, Any]:
        it = self._found(self._forks, "fork", fork) if fork else self.device()
        return it.turns, it.branch

    def _keep(self, store: dict[int, Any], one: Any) -> int:
        if len(store) >= MOST_KEPT:
            raise CommandRefused(f"{MOST_KEPT} are kept already; let go of one first")
        number = next(self._numbers)
        store[number] = one
        return number

    @staticmethod
    def _found(store: dict[int, Any], what: str, number: int) -> Any:
        if number not in store:
            raise CommandRefused(f"there is no {what} {number}")
        return store[number]

"""The joints of a scene on a control board: each gets a motor that is fit for it.

In: the frames of a scene that move. Out: a part of the world; its joints hold their places from the
start. What a description leaves open (force, speed) is chosen here; frames of a scene weigh nothing
(MuJoCo compensates it), so that motors need not hold it.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.control.calibration import Calibrator, Procedure
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.parking import Parking
from robocomp_dsl.hardware.mujoco.axes import MM
from robocomp_dsl.hardware.mujoco.control_board import SimulatedBoard
from robocomp_dsl.hardware.robots.boards import GEAR, SUPPLY, RobotBoard
from robocomp_dsl.hardware.scene import Frame, Motion

_FORCE = {"hinge": 50.0, "slide": 500.0}  # N·m, N
_SPEED = {"hinge": math.tau, "slide": 1.0}  # rad/s, m/s
_INERTIA = 0.005
"""Of a motor per unit of its force: slow against the regulator, which is set by the force, too."""


class JointBoard(SimulatedBoard):
    """The board of the frames `joints`; `homes` (n,) is where each rests [rad, m]."""

    def __init__(self, joints: list[Frame]) -> None:
        moved = [(one.id, one.motion) for one in joints if one.motion]
        n = len(moved)
        spec = BoardSpec(tuple(_joint(*one) for one in moved), tuple(_motor(*one) for one in moved))
        names = tuple(name for name, _ in moved)
        super().__init__(RobotBoard(spec, names, np.eye(n)), hold_weight=False)
        self.homes = np.array([motion.home * _unit(motion) for _, motion in moved])
        homes = np.clip(self.homes, self.board.limits.low, self.board.limits.high)
        self.parking = Parking(self.board, homes)
        self.calibrator = Calibrator(
            self.board, tuple(Procedure(home=float(home)) for home in homes)
        )

    @property
    def names(self) -> tuple[str, ...]:
        """The joints, in order."""
        return self.board.spec.names

    def build(self, spec: Any) -> None:
        """A motor of the joint's name for each."""
        for joint in self.board.spec.joints:
            made = spec.joint(joint.name)
            made.armature = _INERTIA * joint.torque_limit
            spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find joints and motors, and hold what is found."""
        super().bind(model, data, random)
        joints = np.arange(len(self.homes))
        self.board.set_modes(joints, [Mode.POSITION] * len(joints))

    def find(self, model: Any, data: Any) -> None:
        """The same joints in another model."""
        self._data = data
        self._where, self._speed, self._motor = (
            np.array([self._find(model, name)[i] for name in self._joints]) for i in range(3)
        )

    def relocated(self, frame: str) -> None:
        """A joint was moved by hand: it stays there."""
        one = self.board.select.indices([frame])
        now, speed = self._measure()
        self.board.position, self.board.velocity = now + self.board.offset, speed
        self.board.references.reset(one, self.board.position[one])
        self.board.pid.reset(one)


def _unit(motion: Motion) -> float:
    return MM if motion.kind == "slide" else 1.0


def _limits(motion: Motion) -> tuple[float, float]:
    """Low and high in rad or m; none where they do not leave a way between them."""
    if motion.low >= motion.high:
        return -math.inf, math.inf
    return motion.low * _unit(motion), motion.high * _unit(motion)


def _speed_and_force(motion: Motion) -> tuple[float, float]:
    speed = motion.velocity * _unit(motion)
    return (
        speed if 0 < speed < math.inf else _SPEED[motion.kind],
        motion.force if 0 < motion.force < math.inf else _FORCE[motion.kind],
    )


def _joint(name: str, motion: Motion) -> JointSpec:
    low, high = _limits(motion)
    return JointSpec(name, low, high, *_speed_and_force(motion), prismatic=motion.kind == "slide")


def _motor(name: str, motion: Motion) -> MotorSpec:
    """It turns the joint twice as fast as it may and stalls at three times the largest torque.

    A fault comes at six times the current of that torque.
    """
    speed, force = _speed_and_force(motion)
    per_amp = SUPPLY / (2.0 * speed)  # joint torque per ampere: what back EMF allows
    current = force / per_amp
    gear = motion.gear * GEAR if motion.gear > 0 else GEAR
    return MotorSpec(
        name,
        gear=gear,
        torque_constant=per_amp / gear,
        resistance=SUPPLY / (3.0 * current),
        supply=SUPPLY,
        max_current=6.0 * current,
    )

"""The joints of a scene on a control board: each gets a motor that is fit for it.

In: joints, of frames of the scene or of the model file that it begins with. Out: a part of the
world; its joints hold their places from the start. What a description leaves open (force, speed) is
chosen here. Frames of a scene weigh nothing (MuJoCo compensates it), so that motors need not hold
them; what a model file weighs is held.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.control.calibration import Calibrator, Procedure
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.parking import Parking
from robocomp_dsl.hardware.mujoco.axes import MM
from robocomp_dsl.hardware.mujoco.control_board import Floats, SimulatedBoard
from robocomp_dsl.hardware.robots.boards import GEAR, SUPPLY, RobotBoard, shared_limits
from robocomp_dsl.hardware.scene import JOINTS, Device, Frame, Model, Motion, Scene

FORCE = {"hinge": 50.0, "slide": 500.0}
"""Largest torque [N·m] or force [N] where none is given."""

SPEED = {"hinge": math.tau, "slide": 1.0}
"""Largest speed [rad/s, m/s] where none is given."""

_INERTIA = 0.005
"""Of a motor per unit of its force: slow against the regulator, which is set by the force, too."""


@dataclass(frozen=True, slots=True)
class Driven:
    """A joint and its motor in rad, N·m, m, N; the motor has the inertia `armature`.

    Joints of one `group` are served together. `joint` is the joint of the model that has the motor,
    if a board commands it by another one: `force`, `home` and `armature` are its own.
    """

    name: str
    kind: str
    low: float
    high: float
    speed: float
    force: float
    home: float
    armature: float
    gear: float = 1.0
    group: str = ""
    joint: str = ""

    @property
    def own(self) -> str:
        """The joint of the model."""
        return self.joint or self.name


def driven(scene: Scene) -> list[Driven]:
    """The joints of a scene that have motors."""
    given = [_of_device(one) for one in scene.devices if one.kind in JOINTS and _is_given(one)]
    return [*given, *(_of_frame(one, one.motion) for one in scene.frames if one.motion)]


class JointBoard(SimulatedBoard):
    """The board of `joints`; `homes` (n,) is where each rests [rad, m], `groups` by their names.

    Joints of a group share motors as in `model.couplings`, and move those of the model as in
    `model.transmissions`; only what a model weighs is held.
    """

    def __init__(self, joints: Sequence[Driven], model: Model | None = None) -> None:
        motors = tuple(map(_motor, joints))
        coupling = _blocks(joints, model.couplings if model else {})
        transmission = _blocks(joints, model.transmissions if model else {})
        torques = shared_limits(transmission, np.array([one.force for one in joints]))
        specs = tuple(map(_joint, joints, torques.tolist()))
        robot_board = RobotBoard(
            BoardSpec(specs, motors, coupling), tuple(one.own for one in joints), transmission
        )
        super().__init__(robot_board, hold_weight=model is not None)
        self._driven = tuple(joints)
        self._pulled = dict(model.pulled) if model else {}
        self.groups = {one.name: one.group for one in joints}
        self.homes = self._to_joint @ np.array([one.home for one in joints])
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
        """A motor for each, in the place of those that a model file gives it."""
        given: dict[str, list[Any]] = {}
        for motor in spec.actuators:
            if motor.name in self._pulled:
                motor.trntype, motor.target = _ON_JOINTS[0], self._pulled[motor.name]
            if motor.trntype in _ON_JOINTS:
                given.setdefault(motor.target, []).append(motor)
        taken = {motor.name for motor in spec.actuators}
        motors = []
        for one in self._driven:
            spec.joint(one.own).armature = one.armature
            motors.append(_motor_of(spec, one.own, given.get(one.own, []), taken))
        self._motors = tuple(motors)

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find joints and motors, and hold what is found."""
        super().bind(model, data, random)
        joints = np.arange(len(self.homes))
        self.board.set_modes(joints, [Mode.POSITION] * len(joints))

    def relocated(self, frame: str) -> None:
        """A joint was moved by hand: it stays there."""
        one = self.board.select.indices([frame])
        now, speed = self._measure()
        self.board.position, self.board.velocity = now + self.board.offset, speed
        self.board.references.reset(one, self.board.position[one])
        self.board.pid.reset(one)


_ON_JOINTS = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)


def _motor_of(spec: Any, joint: str, given: list[Any], taken: set[str]) -> str:
    """The name of the one motor of a joint, which takes a torque; others of it do nothing."""
    for motor in given:
        motor.set_to_motor()
        motor.forcelimited = motor.ctrllimited = mujoco.mjtLimited.mjLIMITED_FALSE
        motor.gear = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        motor.gainprm[0] = float(motor is given[0])
    if given:
        return str(given[0].name)
    name = joint
    while name in taken:
        name += "'"
    spec.add_actuator(name=name, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    return name


def _blocks(joints: Sequence[Driven], given: Mapping[str, Sequence[float]]) -> Floats:
    """The matrix of all joints, (n, n); joints of different groups share nothing."""
    made = np.eye(len(joints))
    for group, numbers in given.items():
        here = [i for i, one in enumerate(joints) if one.group == group]
        made[np.ix_(here, here)] = np.reshape(numbers, (len(here), len(here)))
    return made


def _is_given(device: Device) -> bool:
    return "board" in device.settings


def _of_device(device: Device) -> Driven:
    """A joint of a model file: all is said in its settings, in MuJoCo's units."""
    words = ("board", "joint")
    given = {name: float(value) for name, value in device.settings.items() if name not in words}
    return Driven(
        device.id,
        "hinge" if device.kind == "joint" else "slide",
        given.get("low", -math.inf),
        given.get("high", math.inf),
        given["speed"],
        given["force"],
        given["home"],
        given["armature"],
        group=str(device.settings["board"]),
        joint=str(device.settings.get("joint", "")),
    )


def _of_frame(frame: Frame, motion: Motion) -> Driven:
    unit = MM if motion.kind == "slide" else 1.0
    low, high = -math.inf, math.inf
    if motion.low < motion.high:  # else they do not leave a way between them
        low, high = motion.low * unit, motion.high * unit
    speed, force = motion.velocity * unit, motion.force
    if not 0 < speed < math.inf:
        speed = SPEED[motion.kind]
    if not 0 < force < math.inf:
        force = FORCE[motion.kind]
    home, gear = motion.home * unit, motion.gear if motion.gear > 0 else 1.0
    return Driven(frame.id, motion.kind, low, high, speed, force, home, _INERTIA * force, gear)


def _joint(one: Driven, torque: float) -> JointSpec:
    slides = one.kind == "slide"
    return JointSpec(one.name, one.low, one.high, one.speed, torque, prismatic=slides)


def _motor(one: Driven) -> MotorSpec:
    """It turns the joint twice as fast as it may and stalls at three times the largest torque.

    A fault comes at six times the current of that torque.
    """
    per_amp = SUPPLY / (2.0 * one.speed)  # joint torque per ampere: what back EMF allows
    current = one.force / per_amp
    gear = one.gear * GEAR
    return MotorSpec(
        one.own,
        gear=gear,
        torque_constant=per_amp / gear,
        resistance=SUPPLY / (3.0 * current),
        supply=SUPPLY,
        max_current=6.0 * current,
    )

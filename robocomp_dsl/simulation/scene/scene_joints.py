"""The joints of a scene on a control board, with motors sized for them.

In: joints of frames of the scene or of its model file. Out: a part of the world; its joints hold
their positions from the start. Forces and speeds that a description leaves open are chosen here.
Frames of a scene are weightless (MuJoCo compensates gravity), so motors need not hold them; the
weight of a model file's bodies is held by feedforward torques.
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
from robocomp_dsl.hardware.description.scene import JOINTS, Device, Frame, Model, Motion, Scene
from robocomp_dsl.simulation.devices.control_board import Floats, SimulatedBoard
from robocomp_dsl.simulation.robots.boards import GEAR, SUPPLY, RobotBoard, shared_limits
from robocomp_dsl.simulation.scene.axes import MM

FORCE = {"hinge": 50.0, "slide": 500.0}
"""Default maximum torque [N·m] or force [N]."""

SPEED = {"hinge": math.tau, "slide": 1.0}
"""Default maximum speed [rad/s, m/s]."""

_INERTIA = 0.005
"""Motor inertia per unit of force: slow compared to the controller, which scales with it, too."""


@dataclass(frozen=True, slots=True)
class DrivenJoint:
    """A joint and its motor in rad, N·m, m, N; the motor has the inertia `armature`.

    Joints of one `group` are served together. `joint` is the model's joint with the motor, if the
    board commands it by another one: `force`, `home` and `armature` are its own.
    """

    name: str
    kind: str
    low: float
    high: float
    speed: float
    force: float
    home: float
    armature: float
    gear: float = GEAR
    group: str = ""
    joint: str = ""

    @property
    def own(self) -> str:
        """The joint of the model."""
        return self.joint or self.name


def driven(scene: Scene) -> list[DrivenJoint]:
    """The joints of a scene that have motors."""
    devices = [
        _of_device(node) for node in scene.devices if node.kind in JOINTS and _is_given(node)
    ]
    return [*devices, *(_of_frame(node, node.motion) for node in scene.frames if node.motion)]


class JointBoard(SimulatedBoard):
    """The board of `joints`; `homes` (n,) are their rest positions [rad, m], `groups` by names.

    Joints of a group share motors as in `model.couplings`, and move those of the model as in
    `model.transmissions`; only the weight of a model's bodies is held.
    """

    def __init__(self, joints: Sequence[DrivenJoint], model: Model | None = None) -> None:
        motors = tuple(map(_motor, joints))
        coupling = _blocks(joints, model.couplings if model else {})
        transmission = _blocks(joints, model.transmissions if model else {})
        torques = shared_limits(transmission, np.array([joint.force for joint in joints]))
        specs = tuple(map(_joint, joints, torques.tolist()))
        robot_board = RobotBoard(
            BoardSpec(specs, motors, coupling), tuple(joint.own for joint in joints), transmission
        )
        super().__init__(robot_board, hold_weight=model is not None)
        self._driven = tuple(joints)
        self._pulled = dict(model.pulled) if model else {}
        self.groups = {joint.name: joint.group for joint in joints}
        self.homes = self._to_joint @ np.array([joint.home for joint in joints])
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
        """Add a motor for each joint; it replaces those of the model file."""
        modelled: dict[str, list[Any]] = {}
        for motor in spec.actuators:
            if motor.name in self._pulled:
                motor.trntype, motor.target = _ON_JOINTS[0], self._pulled[motor.name]
            if motor.trntype in _ON_JOINTS:
                modelled.setdefault(motor.target, []).append(motor)
        taken = {motor.name for motor in spec.actuators}
        motors = []
        for joint in self._driven:
            spec.joint(joint.own).armature = joint.armature
            motors.append(_motor_of(spec, joint.own, modelled.get(joint.own, []), taken))
        self._motors = tuple(motors)

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find joints and motors, and hold their positions."""
        super().bind(model, data, random)
        joints = np.arange(len(self.homes))
        self.board.set_modes(joints, [Mode.POSITION] * len(joints))

    def update_frame(self, frame: str) -> None:
        """A joint was moved externally: it holds the new position."""
        joint = self.board.select.indices([frame])
        now, speed = self._measure()
        self.board.position, self.board.velocity = now + self.board.offset, speed
        self.board.references.reset(joint, self.board.position[joint])
        self.board.pid.reset(joint)


_ON_JOINTS = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)


def _motor_of(spec: Any, joint: str, modelled: list[Any], taken: set[str]) -> str:
    """The name of a joint's only motor, which takes a torque; its other motors are disabled."""
    for motor in modelled:
        motor.set_to_motor()
        motor.forcelimited = motor.ctrllimited = mujoco.mjtLimited.mjLIMITED_FALSE
        motor.gear = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        motor.gainprm[0] = float(motor is modelled[0])
    if modelled:
        return str(modelled[0].name)
    name = joint
    while name in taken:
        name += "'"
    spec.add_actuator(name=name, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    return name


def _blocks(joints: Sequence[DrivenJoint], couplings: Mapping[str, Sequence[float]]) -> Floats:
    """The matrix of all joints, (n, n); joints of different groups share nothing."""
    blocks = np.eye(len(joints))
    for group, numbers in couplings.items():
        here = [i for i, joint in enumerate(joints) if joint.group == group]
        blocks[np.ix_(here, here)] = np.reshape(numbers, (len(here), len(here)))
    return blocks


def _is_given(device: Device) -> bool:
    return "board" in device.settings


def _of_device(device: Device) -> DrivenJoint:
    """A joint of a model file: its settings are complete, in MuJoCo's units."""
    words = ("board", "joint")
    settings = {name: float(value) for name, value in device.settings.items() if name not in words}
    return DrivenJoint(
        device.id,
        "hinge" if device.kind == "joint" else "slide",
        settings.get("low", -math.inf),
        settings.get("high", math.inf),
        settings["speed"],
        settings["force"],
        settings["home"],
        settings["armature"],
        group=str(device.settings["board"]),
        joint=str(device.settings.get("joint", "")),
    )


def _of_frame(frame: Frame, motion: Motion) -> DrivenJoint:
    unit = MM if motion.kind == "slide" else 1.0
    low, high = -math.inf, math.inf
    if motion.low < motion.high:  # otherwise their range would be empty
        low, high = motion.low * unit, motion.high * unit
    speed, force = motion.velocity * unit, motion.force
    if not 0 < speed < math.inf:
        speed = SPEED[motion.kind]
    if not 0 < force < math.inf:
        force = FORCE[motion.kind]
    home, gear = motion.home * unit, motion.gear if motion.gear > 0 else GEAR
    return DrivenJoint(frame.id, motion.kind, low, high, speed, force, home, _INERTIA * force, gear)


def _joint(joint: DrivenJoint, torque: float) -> JointSpec:
    slides = joint.kind == "slide"
    return JointSpec(joint.name, joint.low, joint.high, joint.speed, torque, prismatic=slides)


def _motor(joint: DrivenJoint) -> MotorSpec:
    """A motor that turns the joint at twice its speed limit and stalls at three times its torque.

    A fault occurs at six times the current of that torque.
    """
    per_amp = SUPPLY / (2.0 * joint.speed)  # joint torque per ampere, limited by back EMF
    current = joint.force / per_amp
    return MotorSpec(
        joint.own,
        gear=joint.gear,
        torque_constant=per_amp / joint.gear,
        resistance=SUPPLY / (3.0 * current),
        supply=SUPPLY,
        max_current=6.0 * current,
    )

"""The motors of each joint in a model file, their maximum force, and their minimum inertia.

In: the compiled model. Out: the motors by joint, the maximum torque [N·m] or force [N] of a joint,
and the inertia of its motor. If all joints of a tendon but one follow that one, as the fingers of
a gripper do, the tendon's motor belongs to that joint.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.scene.scene_joints import FORCE

_ON_JOINTS = {int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)}
_ON_TENDON = int(mujoco.mjtTrn.mjTRN_TENDON)
_PLAIN = (mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_NONE)
_STRONG = 2.0
"""Default force of a joint, as a multiple of the weight that it may carry."""

_SLOWEST = 0.001
_SLOWNESS = 1.0
"""Minimum inertia [kg m²] of a joint per N·m, and per N·m and second of a step: controllers with a
damping of half their torque per rad/s are then stable."""


@dataclass(frozen=True, slots=True)
class JointActuator:
    """A motor, and the ratio of its force at the joint."""

    motor: int
    gain: float = 1.0


def motors_of(model: Any) -> dict[int, list[JointActuator]]:
    """The actuators of each joint; those of tendons only if it has no other."""
    found: dict[int, list[JointActuator]] = {}
    for motor in range(model.nu):
        if int(model.actuator_trntype[motor]) in _ON_JOINTS:
            found.setdefault(int(model.actuator_trnid[motor, 0]), []).append(JointActuator(motor))
    pulled: dict[int, list[JointActuator]] = {}
    for motor in range(model.nu):
        if int(model.actuator_trntype[motor]) == _ON_TENDON:
            joint, gain = _of_tendon(model, int(model.actuator_trnid[motor, 0]))
            if gain and joint not in found:
                pulled.setdefault(joint, []).append(JointActuator(motor, gain))
    return found | pulled


def through_tendons(model: Any) -> dict[str, str]:
    """The joints moved by motors of tendons, by motor names."""
    return {
        model.actuator(motor.motor).name: model.joint(joint).name
        for joint, motors in motors_of(model).items()
        for motor in motors
        if int(model.actuator_trntype[motor.motor]) == _ON_TENDON
    }


def others(model: Any) -> list[str]:
    """The actuators that act on other elements than joints."""
    known = {actuator.motor for motors in motors_of(model).values() for actuator in motors}
    return [model.actuator(motor).name for motor in range(model.nu) if motor not in known]


def followers(model: Any) -> dict[int, tuple[int, float]]:
    """Coupled joints: their leader, and the ratio of their speeds."""
    return {
        int(model.eq_obj1id[i]): (int(model.eq_obj2id[i]), float(model.eq_data[i, 1]))
        for i in range(model.neq)
        if int(model.eq_type[i]) == int(mujoco.mjtEq.mjEQ_JOINT)
        and model.eq_active0[i]
        and model.eq_obj2id[i] >= 0
    }


def _of_tendon(model: Any, tendon: int) -> tuple[int, float]:
    """The joint that a tendon moves, and its length per motion of it; 0: not a single joint."""
    first = int(model.tendon_adr[tendon])
    parts = range(first, first + int(model.tendon_num[tendon]))
    if any(int(model.wrap_type[i]) != int(mujoco.mjtWrap.mjWRAP_JOINT) for i in parts):
        return -1, 0.0
    tied, lengths = followers(model), dict[int, float]()
    for i in parts:
        joint, share = int(model.wrap_objid[i]), float(model.wrap_prm[i])
        leads, faster = tied.get(joint, (joint, 1.0))
        lengths[leads] = lengths.get(leads, 0.0) + share * faster
    joint, length = lengths.popitem()
    return (joint, length) if not lengths and joint not in tied else (-1, 0.0)


def force_of(model: Any, joint: int, kind: str, motors: list[JointActuator]) -> float:
    """The force in the file, or the default that holds the weight it carries."""
    known = [most for motor in motors if (most := _most(model, motor)) < math.inf]
    force = max(known, default=math.inf)
    if model.jnt_actfrclimited[joint]:
        force = min(force, float(np.abs(model.jnt_actfrcrange[joint]).max()))
    if 0 < force < math.inf:
        return force
    return max(FORCE[kind], _STRONG * _weight(model, joint, kind))


def _most(model: Any, acting: JointActuator) -> float:
    """The maximum force of an actuator at its joint."""
    found, motor = math.inf, acting.motor
    kind = (
        mujoco.mjtGain(model.actuator_gaintype[motor]),
        mujoco.mjtBias(model.actuator_biastype[motor]),
    )
    if kind == _PLAIN and model.actuator_ctrllimited[motor]:
        gain = abs(float(model.actuator_gainprm[motor, 0]))
        found = gain * float(np.abs(model.actuator_ctrlrange[motor]).max())
    if model.actuator_forcelimited[motor]:
        found = min(found, float(np.abs(model.actuator_forcerange[motor]).max()))
    return found * abs(float(model.actuator_gear[motor, 0]) * acting.gain)


def _weight(model: Any, joint: int, kind: str) -> float:
    """The maximum gravity load of a joint, with all that it carries stretched out."""
    body = int(model.jnt_bodyid[joint])
    mass = float(model.body_subtreemass[body]) * float(np.linalg.norm(model.opt.gravity))
    return mass if kind == "slide" else mass * _reach(model, body)


def _reach(model: Any, body: int) -> float:
    """Maximum distance of the masses that a body carries [m]."""
    far = {body: 0.0}
    for below in range(body + 1, model.nbody):
        above = int(model.body_parentid[below])
        if above in far:
            far[below] = far[above] + float(np.linalg.norm(model.body_pos[below]))
    return max(way + float(np.linalg.norm(model.body_ipos[below])) for below, way in far.items())


def armature_of(model: Any, joint: int, force: float) -> tuple[float, bool]:
    """The motor's inertia, increased to what a controller of that force needs to be stable.

    Also returns whether it differs from the file; a file without armature leaves it open.
    """
    dof = int(model.jnt_dofadr[joint])
    there = float(model.dof_armature[dof])
    inertia = 1.0 / max(float(model.dof_invweight0[dof]), 1e-12)
    missing = force * max(_SLOWEST, _SLOWNESS * float(model.opt.timestep)) - inertia
    return (there, False) if missing <= 0 else (there + missing, there > 0)

"""How strong the motors of a model file are, and how slow they must be.

In: the compiled model. Out: the largest torque [N·m] or force [N] of a joint, and the inertia that
its motor has.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.mujoco.scene_joints import FORCE

_ON_JOINTS = {int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)}
_PLAIN = (mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_NONE)
_STRONG = 2.0
"""A joint of unknown force holds so many times the weight that it may carry."""

_SLOWEST = 0.001
_SLOWNESS = 1.0
"""Least inertia [kg m²] of a joint for each N·m, and for each N·m and second of a step: a regulator
whose damping is half its torque per rad/s stays calm then."""


def motors_of(model: Any) -> dict[int, list[int]]:
    """The actuators that act on a joint, by joint."""
    found: dict[int, list[int]] = {}
    for motor in range(model.nu):
        if int(model.actuator_trntype[motor]) in _ON_JOINTS:
            found.setdefault(int(model.actuator_trnid[motor, 0]), []).append(motor)
    return found


def others(model: Any) -> list[str]:
    """The actuators that act on something else."""
    return [
        model.actuator(motor).name
        for motor in range(model.nu)
        if int(model.actuator_trntype[motor]) not in _ON_JOINTS
    ]


def force_of(model: Any, joint: int, kind: str, motors: list[int]) -> float:
    """What the file gives it, or else what is usual and holds what it carries."""
    known = [most for one in motors if (most := _most(model, one)) < math.inf]
    force = max(known, default=math.inf)
    if model.jnt_actfrclimited[joint]:
        force = min(force, float(np.abs(model.jnt_actfrcrange[joint]).max()))
    if 0 < force < math.inf:
        return force
    return max(FORCE[kind], _STRONG * _weight(model, joint, kind))


def _most(model: Any, motor: int) -> float:
    """The largest force of an actuator at its joint."""
    found = math.inf
    kind = (
        mujoco.mjtGain(model.actuator_gaintype[motor]),
        mujoco.mjtBias(model.actuator_biastype[motor]),
    )
    if kind == _PLAIN and model.actuator_ctrllimited[motor]:
        gain = abs(float(model.actuator_gainprm[motor, 0]))
        found = gain * float(np.abs(model.actuator_ctrlrange[motor]).max())
    if model.actuator_forcelimited[motor]:
        found = min(found, float(np.abs(model.actuator_forcerange[motor]).max()))
    return found * abs(float(model.actuator_gear[motor, 0]))


def _weight(model: Any, joint: int, kind: str) -> float:
    """The most that gravity pulls at a joint: all that it carries, stretched out."""
    body = int(model.jnt_bodyid[joint])
    mass = float(model.body_subtreemass[body]) * float(np.linalg.norm(model.opt.gravity))
    return mass if kind == "slide" else mass * _reach(model, body)


def _reach(model: Any, body: int) -> float:
    """How far the masses that a body carries may be from it [m]."""
    far = {body: 0.0}
    for one in range(body + 1, model.nbody):
        above = int(model.body_parentid[one])
        if above in far:
            far[one] = far[above] + float(np.linalg.norm(model.body_pos[one]))
    return max(way + float(np.linalg.norm(model.body_ipos[one])) for one, way in far.items())


def armature_of(model: Any, joint: int, force: float) -> tuple[float, bool]:
    """The motor's inertia, with what a regulator of so much force needs to stay calm.

    And whether the file says something else: one that tells no armature leaves it open.
    """
    dof = int(model.jnt_dofadr[joint])
    there = float(model.dof_armature[dof])
    inertia = 1.0 / max(float(model.dof_invweight0[dof]), 1e-12)
    missing = force * max(_SLOWEST, _SLOWNESS * float(model.opt.timestep)) - inertia
    return (there, False) if missing <= 0 else (there + missing, there > 0)

"""Converts between arrays of the library and structs of the interface.

In: arrays and chains of `robocomp_dsl.tactile`. Out: structs of GenericArm.idsl, and back.
"""

from __future__ import annotations

import numpy as np
from generic_arm_generated.interfaces import ArmLimits, ArmState, Chain, Pose, Row, Rows

from robocomp_dsl.tactile.arm import chain as kinematics
from robocomp_dsl.tactile.arm.generic_arm import GenericArm
from robocomp_dsl.tactile.arrays import Floats


def state_to_message(arm: GenericArm, *, moving: bool) -> ArmState:
    """The latest state; the arm must have one."""
    state = arm.current_state()
    return ArmState(state.time, state.position, state.velocity, state.torque, moving)


def limits_to_message(arm: GenericArm) -> ArmLimits:
    """Limits, start pose, and which joints exist."""
    return ArmLimits(
        arm.low, arm.high, arm.speed_limits, arm.part.start, arm.mapping.available.copy()
    )


def chain_to_message(chain: kinematics.Chain) -> Chain:
    """The rows of the chain, base and tool."""
    rows = [
        Row(row.a, row.d, row.alpha, row.offset, -1 if row.joint is None else row.joint)
        for row in chain.rows
    ]
    return Chain(Rows(rows), chain.base.ravel().copy(), chain.tool.ravel().copy())


def pose_to_message(pose: Floats) -> Pose:
    """The message of a pose (4, 4)."""
    return Pose(*pose[:3, 3].tolist(), *pose[:3, :3].ravel().tolist())


def position_of(pose: Pose) -> Floats:
    """The position, (3,) in m."""
    return np.array([pose.x, pose.y, pose.z])


def rotation_of(pose: Pose) -> Floats:
    """The rotation matrix, (3, 3)."""
    return np.array(
        [
            [pose.r00, pose.r01, pose.r02],
            [pose.r10, pose.r11, pose.r12],
            [pose.r20, pose.r21, pose.r22],
        ]
    )

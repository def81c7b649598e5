"""What the library knows of the arm as the structs of the interface.

In: arrays and chains of `robocomp_dsl.tactile`. Out: what callers of `GenericArm` get.
"""

from __future__ import annotations

import numpy as np
from generated.interfaces import ArmLimits, ArmState, Chain, Pose, Row, Rows

from robocomp_dsl.tactile.arm import chain as kinematics
from robocomp_dsl.tactile.arm.generic_arm import GenericArm
from robocomp_dsl.tactile.arrays import Floats


def told_state(arm: GenericArm, *, moving: bool) -> ArmState:
    """The state that was taken in last; there must be one."""
    it = arm.now()
    return ArmState(it.time, it.position, it.velocity, it.torque, moving)


def told_limits(arm: GenericArm) -> ArmLimits:
    """Limits, start pose, and which joints there are."""
    return ArmLimits(
        arm.low, arm.high, arm.speed_limits, arm.part.start, arm.mapping.available.copy()
    )


def told_chain(chain: kinematics.Chain) -> Chain:
    """The rows, base and tool."""
    rows = [
        Row(one.a, one.d, one.alpha, one.offset, -1 if one.joint is None else one.joint)
        for one in chain.rows
    ]
    return Chain(Rows(rows), chain.base.ravel().copy(), chain.tool.ravel().copy())


def told_pose(pose: Floats) -> Pose:
    """A pose 4 x 4."""
    return Pose(*pose[:3, 3].tolist(), *pose[:3, :3].ravel().tolist())


def position_of(pose: Pose) -> Floats:
    """Where it is, (3,)."""
    return np.array([pose.x, pose.y, pose.z])


def rotation_of(pose: Pose) -> Floats:
    """How it is turned, (3, 3)."""
    return np.array(
        [
            [pose.r00, pose.r01, pose.r02],
            [pose.r10, pose.r11, pose.r12],
            [pose.r20, pose.r21, pose.r22],
        ]
    )

"""Describes the nodes of a model, for panels.

In: a model. Out: the tree of its bodies as Markdown, their joints, rotations as Euler angles.
"""

from __future__ import annotations

import html
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.kinematics.rotations import angles

_MOST_LISTED = 2000
_JOINT = mujoco.mjtJoint
_KINDS = {
    int(_JOINT.mjJNT_FREE): "free",
    int(_JOINT.mjJNT_BALL): "ball",
    int(_JOINT.mjJNT_SLIDE): "slide",
    int(_JOINT.mjJNT_HINGE): "hinge",
}


def tree(model: Any, names: list[str]) -> str:
    """The bodies as a nested list of Markdown."""
    depth, lines = [0] * model.nbody, list[str]()
    below: list[list[int]] = [[] for _ in names]
    for i in range(1, model.nbody):
        below[model.body_parentid[i]].append(i)
        depth[i] = depth[model.body_parentid[i]] + 1
    todo = below[0][::-1]
    while todo and len(lines) < _MOST_LISTED:
        i = todo.pop()
        indent = "  " * min(depth[i] - 1, 12)
        lines.append(f"{indent}- {html.escape(names[i])} ({moves(model, i)})")
        todo += below[i][::-1]
    if todo:
        lines.append(f"\n{model.nbody - 1} nodes, the first {_MOST_LISTED} are listed")
    return "\n".join(lines)


def moves(model: Any, body: int) -> str:
    """The kinds of the joints that move a body, as text."""
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    kinds = [kind_of(model, j) for j in range(first, first + count)]
    return ", ".join(kinds) or "fixed"


def kind_of(model: Any, joint: int) -> str:
    """The kind of a joint, as one word."""
    # numpy integers never compare equal to MuJoCo's enumerators
    return _KINDS[int(model.jnt_type[joint])]


def quaternion(turn: Any) -> Any:
    """(w, x, y, z) of roll, pitch and yaw about the fixed axes."""
    quat = np.zeros(4)
    mujoco.mju_euler2Quat(quat, np.array(turn, dtype=float), "XYZ")
    return quat


def roll_pitch_yaw(quat: Any) -> tuple[float, float, float]:
    """Roll, pitch, yaw of (w, x, y, z): of the two solutions the one of the smaller norm."""
    flat = np.zeros(9)
    mujoco.mju_quat2Mat(flat, quat / np.linalg.norm(quat))
    # Rz(yaw)·Ry(pitch)·Rx(roll) is the inverse of Rx(-roll)·Ry(-pitch)·Rz(-yaw)
    roll, pitch, yaw = angles(flat.reshape(3, 3).T)
    return 0.0 - roll, 0.0 - pitch, 0.0 - yaw

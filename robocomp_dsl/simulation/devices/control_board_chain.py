"""Extracts the chain of joints from a base to a tip from a compiled MuJoCo model.

In: the model, a board's joints, a site or body as tip. Out: `Chain`, with its own tree.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.scene import ROOT, Frame
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.kinematics.cartesian import JointChain
from robocomp_dsl.hardware.kinematics.rotations import angles
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms, model_transforms
from robocomp_dsl.simulation.scene import axes

_TIP = "tip of the chain"


def extract_chain(
    model: Any, joints: Sequence[str], tip: str, *, base: str = "", prefix: str = ""
) -> JointChain:
    """The chain of `joints` that carries the site `tip`, or else the body of that name.

    Poses are expressed in the body `base`, or in the world; the rest posture is the middle of the
    limits. Raises `SceneError` for missing names, and for joints that do not move the tip.
    """
    mirrored = model_transforms(model)
    end = _tip(model, mirrored, prefix + tip)
    root = mirrored.bodies[_body(model, prefix + base)] if base else ROOT
    frames = {joint_frame.name: joint_frame.frame for joint_frame in mirrored.joints}
    carrying, ranges = mirrored.tree.path(end), []
    for joint in joints:
        frame = frames.get(prefix + joint)
        if frame is None:
            raise SceneError(f"the world has no joint `{prefix + joint}`")
        if frame not in carrying:
            raise SceneError(f"the joint `{joint}` does not move `{tip}`")
        ranges.append(model.joint(prefix + joint).range)
    low, high = np.array(ranges).T
    names = tuple(frames[prefix + joint] for joint in joints)
    held = {
        name.removeprefix(prefix): frame
        for name, frame in frames.items()
        if frame in carrying and frame not in names
    }
    return JointChain(mirrored.tree, names, end, low, high, (low + high) / 2, root, held)


def _tip(model: Any, mirrored: ModelTransforms, name: str) -> str:
    """The frame of a body, or of a site (a new frame, since a body may have its name)."""
    at = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name)
    if at < 0:
        return mirrored.bodies[_body(model, name)]
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.site_quat[at])
    pose = axes.matrix(model.site_pos[at], turned)
    x, y, z = pose[:3, 3].tolist()
    body = mirrored.bodies[model.site_bodyid[at]]
    mirrored.tree.add(Frame(_TIP, body, (x, y, z), angles(pose[:3, :3])))
    return _TIP


def _body(model: Any, name: str) -> int:
    found = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    if found < 0:
        raise SceneError(f"the world has no body or site `{name}`")
    return int(found)

"""The end effectors of a model file, as Cartesian controllers of a scene.

In: the compiled model, and the joints on its boards. Out: a device for each

    <custom> <text name="cartesian_LArm" data="l_hand torso"/> </custom>

which names a board, the body or site that its joints move, and the body in which poses are
expressed (default: the world). Joints named after these are not moved, such as those of fingers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.description.scene import JOINTS
from robocomp_dsl.simulation.models.model_texts import texts_of
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms

PREFIX = "cartesian_"

Data = dict[str, Any]


def end_effectors_of(
    model: Any, seen: ModelTransforms, devices: Sequence[Data], findings: list[Finding]
) -> list[Data]:
    """A device for every end effector; invalid ones are findings."""
    devices_found: list[Data] = []
    for name, words in texts_of(model).items():
        if not name.startswith(PREFIX):
            continue
        try:
            devices_found.append(_end_effector(model, seen, devices, name, words))
        except _InvalidEndEffector as why:
            findings.append(model_finding("joint", "", f"`{name}` {why}: it is left out"))
    return devices_found


class _InvalidEndEffector(Exception):
    """The reason why a text does not describe an end effector."""


def _end_effector(
    model: Any, seen: ModelTransforms, devices: Sequence[Data], name: str, words: Sequence[str]
) -> Data:
    """The device. Raises `_InvalidEndEffector`."""
    board = name.removeprefix(PREFIX)
    joints = [d for d in devices if d["kind"] in JOINTS and d["settings"]["board"] == board]
    if not joints:
        raise _InvalidEndEffector(f"names no control board `{board}`")
    if not words:
        raise _InvalidEndEffector("names no tip")
    tip, base, left = words[0], "".join(words[1:2]), words[2:]
    frame = _frame(model, seen, tip)
    if not frame:
        raise _InvalidEndEffector(f"names no body or site `{tip}`")
    if unknown := [joint for joint in left if joint not in {d["id"] for d in joints}]:
        raise _InvalidEndEffector(f"names no joint `{unknown[0]}` of `{board}`")
    if base and mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, base) < 0:
        raise _InvalidEndEffector(f"names no body `{base}`")
    carrying = {at: i for i, at in enumerate(seen.tree.path(frame))}
    moving = [d for d in joints if d["frame"] in carrying and d["id"] not in left]
    moving.sort(key=lambda device: -carrying[device["frame"]])  # from the base to the tip
    if any("joint" in d["settings"] for d in moving):
        raise _InvalidEndEffector(
            f"is moved by joints that the board commands through other joints: `{tip}`"
        )
    if any(d["kind"] == "prismaticjoint" for d in moving):
        raise _InvalidEndEffector(f"is moved by a joint that slides: `{tip}` cannot be led")
    if not moving or any("low" not in d["settings"] for d in moving):
        raise _InvalidEndEffector(f"has no joints with limits that move `{tip}`")
    settings = {"joints": "\n".join(d["id"] for d in moving), "tip": tip, "base": base}
    return {"id": name, "kind": "cartesian", "frame": frame, "settings": settings}


def _frame(model: Any, seen: ModelTransforms, name: str) -> str:
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name)
    if site >= 0:
        return str(seen.sites[site])
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    return str(seen.bodies[body]) if body >= 0 else ""

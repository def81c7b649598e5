"""The hands of a model file that Cartesian controllers take to poses, as devices of a scene.

In: the compiled model, and the joints on its boards. Out: a device for each

    <custom> <text name="cartesian_LArm" data="l_hand torso"/> </custom>

which names a board, the body or site that its joints move, and the body that poses are told in
(without one: the world). Joints that are named behind are left as they are, as those of fingers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco

from robocomp_dsl.hardware.findings import Finding
from robocomp_dsl.hardware.mujoco.mirror import Mirror
from robocomp_dsl.hardware.mujoco.model_texts import texts_of
from robocomp_dsl.hardware.scene import JOINTS

PREFIX = "cartesian_"

Data = dict[str, Any]


def hands_of(
    model: Any, seen: Mirror, devices: Sequence[Data], findings: list[Finding]
) -> list[Data]:
    """A device for every hand; what cannot be one is a finding."""
    made: list[Data] = []
    for name, told in texts_of(model).items():
        if not name.startswith(PREFIX):
            continue
        try:
            made.append(_hand(model, seen, devices, name, told))
        except _NoHand as why:
            findings.append(Finding("joint", "", f"`{name}` {why}: it is left out"))
    return made


class _NoHand(Exception):
    """Why a text is no hand."""


def _hand(
    model: Any, seen: Mirror, devices: Sequence[Data], name: str, told: Sequence[str]
) -> Data:
    """The device. Raises `_NoHand`."""
    board = name.removeprefix(PREFIX)
    joints = [d for d in devices if d["kind"] in JOINTS and d["settings"]["board"] == board]
    if not joints:
        raise _NoHand(f"names no control board `{board}`")
    if not told:
        raise _NoHand("tells no tip")
    tip, base, left = told[0], "".join(told[1:2]), told[2:]
    frame = _frame(model, seen, tip)
    if not frame:
        raise _NoHand(f"names no body or site `{tip}`")
    if unknown := [one for one in left if one not in {d["id"] for d in joints}]:
        raise _NoHand(f"names no joint `{unknown[0]}` of `{board}`")
    if base and mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, base) < 0:
        raise _NoHand(f"names no body `{base}`")
    carrying = {at: i for i, at in enumerate(seen.tree.path(frame))}
    moving = [d for d in joints if d["frame"] in carrying and d["id"] not in left]
    moving.sort(key=lambda device: -carrying[device["frame"]])  # from the base to the tip
    if any("joint" in d["settings"] for d in moving):
        raise _NoHand(f"is moved by joints that the board commands by others: `{tip}`")
    if any(d["kind"] == "prismaticjoint" for d in moving):
        raise _NoHand(f"is moved by a joint that slides: `{tip}` cannot be led")
    if not moving or any("low" not in d["settings"] for d in moving):
        raise _NoHand(f"has no joints with limits that move `{tip}`")
    settings = {"joints": "\n".join(d["id"] for d in moving), "tip": tip, "base": base}
    return {"id": name, "kind": "cartesian", "frame": frame, "settings": settings}


def _frame(model: Any, seen: Mirror, name: str) -> str:
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name)
    if site >= 0:
        return str(seen.sites[site])
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    return str(seen.bodies[body]) if body >= 0 else ""

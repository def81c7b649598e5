"""The joints of a model file that have motors, as devices of a scene.

In: the compiled model. Out: a device for each, with its limits in MuJoCo's units. A joint that
follows another by an equality has no motor; neither has one without an actuator where others of
the file have some: it swings freely, as the file means it.

    <custom>
      <tuple name="LArm"> <element objtype="joint" objname="LElbowRoll"/> </tuple>
      <numeric name="speed_LElbowRoll" data="7.2"/>
      <numeric name="coupling_LArm" data="1"/>
    </custom>

makes a control board `LArm`, tells the largest speed of a joint in rad/s or m/s, and how the motors
of a board turn with its n joints: n · n numbers, row by row.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.findings import Finding
from robocomp_dsl.hardware.mujoco.mirror import Mirror
from robocomp_dsl.hardware.mujoco.model_motors import (
    Acting,
    armature_of,
    followers,
    force_of,
    motors_of,
    others,
)
from robocomp_dsl.hardware.mujoco.model_start import Started
from robocomp_dsl.hardware.mujoco.scene_joints import SPEED
from robocomp_dsl.hardware.scene import JOINTS

_KINDS = {mujoco.mjtJoint.mjJNT_HINGE: "joint", mujoco.mjtJoint.mjJNT_SLIDE: "prismaticjoint"}
_MOVES = {"joint": "hinge", "prismaticjoint": "slide"}
_MOST_NAMED = 5

Data = dict[str, Any]


def joints_of(model: Any, seen: Mirror, started: Started) -> list[Data]:
    """A device for every joint, those without a motor under kinds that nothing is served as."""
    frames = {one.name: one.frame for one in seen.joints}
    motors = motors_of(model)
    tied = followers(model)
    boards = _boards(model, started.findings)
    made, light = [], list[tuple[str, float]]()
    for joint in (*boards, *(one for one in range(model.njnt) if one not in boards)):
        name = model.joint(joint).name
        kind = _KINDS.get(mujoco.mjtJoint(model.jnt_type[joint]))
        if kind is None:
            continue
        without = joint in tied or (motors and joint not in motors and joint not in boards)
        if without:
            said = "followingjoint" if joint in tied else "passivejoint"
            made.append({"id": name, "kind": said, "frame": frames[name], "settings": {}})
            continue
        settings = _settings(model, joint, kind, motors.get(joint, []), started, light)
        settings["board"] = boards.get(joint, "")
        made.append({"id": name, "kind": kind, "frame": frames[name], "settings": settings})
    told = started.findings
    if light:
        each = [f"`{name}` ({armature:.2g})" for name, armature in light]
        said = f"too light for their motors at this step, they get more `armature`: {_few(each)}"
        told.append(Finding("joint", light[0][0], said))
    if left := [f"`{name}`" for name in others(model)]:
        said = "not on one joint, so on no control board; they keep the commands of the start"
        told.append(Finding("joint", "", f"{said}: {_few(left)}"))
    return made


def _settings(
    model: Any,
    joint: int,
    kind: str,
    motors: list[Acting],
    started: Started,
    light: list[tuple[str, float]],
) -> Data:
    name = model.joint(joint).name
    force = force_of(model, joint, _MOVES[kind], motors)
    armature, is_light = armature_of(model, joint, force)
    if is_light:
        light.append((name, armature))
    home = started.start.get(name, model.joint(joint).qpos0)[0]
    made: Data = {
        "speed": _speed(model, name, started.findings) or SPEED[_MOVES[kind]],
        "force": force,
        "home": float(home),
        "armature": armature,
    }
    if model.jnt_limited[joint]:
        made["low"], made["high"] = model.jnt_range[joint].tolist()
    return made


def _boards(model: Any, findings: list[Finding]) -> dict[int, str]:
    """The board of joints that are in a tuple, in its order; the first one of a joint counts."""
    found: dict[int, str] = {}
    for i in range(model.ntuple):
        first, size = int(model.tuple_adr[i]), int(model.tuple_size[i])
        for at in range(first, first + size):
            if int(model.tuple_objtype[at]) != int(mujoco.mjtObj.mjOBJ_JOINT):
                continue
            joint, name = int(model.tuple_objid[at]), model.tuple(i).name
            board = found.setdefault(joint, name)
            if board != name:
                said = (
                    f"`{model.joint(joint).name}` is in `{name}` and stays on the board `{board}`"
                )
                findings.append(Finding("joint", model.joint(joint).name, said))
    return found


def couplings_of(model: Any, devices: Sequence[Data], findings: list[Finding]) -> Data:
    """The matrix of each board that the file tells one of, as a list of numbers."""
    boards = Counter(one["settings"]["board"] for one in devices if one["kind"] in JOINTS)
    found: Data = {}
    for board, n in boards.items():
        name = f"coupling_{board}"
        if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name) < 0 or not board:
            continue
        told = model.numeric(name).data
        fits = len(told) == n * n and np.isfinite(told).all()
        if fits and np.linalg.matrix_rank(told.reshape(n, n)) == n:
            found[board] = told.tolist()
            continue
        said = f"`{name}` is no {n} x {n} matrix that can be turned round: it is left out"
        findings.append(Finding("joint", "", said))
    return found


def _speed(model: Any, joint: str, findings: list[Finding]) -> float:
    """The largest speed that the file tells; 0: it tells none."""
    name = f"speed_{joint}"
    at = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name)
    if at < 0:
        return 0.0
    told = float(model.numeric(name).data[0])
    if 0 < told < math.inf:
        return told
    findings.append(Finding("joint", joint, f"`{name}` is {told:g}, no speed: the usual is taken"))
    return 0.0


def _few(told: list[str]) -> str:
    """The first of many."""
    more = f" and {len(told) - _MOST_NAMED} more" if len(told) > _MOST_NAMED else ""
    return ", ".join(told[:_MOST_NAMED]) + more

"""The joints of a model file that have motors, as devices of a scene.

In: the compiled model. Out: a device for each, with its limits in MuJoCo's units. A joint that
follows another by an equality has no motor; if any joint of the file has an actuator, joints
without one have no motor either and swing freely.

    <custom>
      <tuple name="LArm"> <element objtype="joint" objname="LElbowRoll"/> </tuple>
      <numeric name="speed_LElbowRoll" data="7.2"/>
      <numeric name="coupling_LArm" data="1"/>
    </custom>

defines a control board `LArm`, the maximum speed of a joint in rad/s or m/s, and the coupling of
the motors of a board with its n joints: n · n numbers, row by row.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.description.scene import JOINTS
from robocomp_dsl.simulation.models.model_motors import (
    JointActuator,
    armature_of,
    followers,
    force_of,
    motors_of,
    others,
)
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms
from robocomp_dsl.simulation.models.start_spec import StartSpec
from robocomp_dsl.simulation.scene.scene_joints import SPEED

_KINDS = {mujoco.mjtJoint.mjJNT_HINGE: "joint", mujoco.mjtJoint.mjJNT_SLIDE: "prismaticjoint"}
_MOVES = {"joint": "hinge", "prismaticjoint": "slide"}
_MOST_NAMED = 5

Data = dict[str, Any]


def joints_of(model: Any, seen: ModelTransforms, started: StartSpec) -> list[Data]:
    """A device for every joint; joints without a motor have kinds that no interface serves."""
    frames = {model_joint.name: model_joint.frame for model_joint in seen.joints}
    motors = motors_of(model)
    tied = followers(model)
    boards = _boards(model, started.findings)
    devices, light = [], list[tuple[str, float]]()
    for joint in (
        *boards,
        *(model_joint for model_joint in range(model.njnt) if model_joint not in boards),
    ):
        name = model.joint(joint).name
        kind = _KINDS.get(mujoco.mjtJoint(model.jnt_type[joint]))
        if kind is None:
            continue
        without = joint in tied or (motors and joint not in motors and joint not in boards)
        if without:
            device_kind = "followingjoint" if joint in tied else "passivejoint"
            devices.append({"id": name, "kind": device_kind, "frame": frames[name], "settings": {}})
            continue
        settings = _settings(model, joint, kind, motors.get(joint, []), started, light)
        settings["board"] = boards.get(joint, "")
        devices.append({"id": name, "kind": kind, "frame": frames[name], "settings": settings})
    findings = started.findings
    if light:
        each = [f"`{name}` ({armature:.2g})" for name, armature in light]
        device_kind = (
            f"too light for their motors at this step, they get more `armature`: {_few(each)}"
        )
        findings.append(model_finding("joint", light[0][0], device_kind))
    if left := [f"`{name}`" for name in others(model)]:
        device_kind = (
            "not on one joint, so on no control board; they keep the commands of the start"
        )
        findings.append(model_finding("joint", "", f"{device_kind}: {_few(left)}"))
    return devices


def _settings(
    model: Any,
    joint: int,
    kind: str,
    motors: list[JointActuator],
    started: StartSpec,
    light: list[tuple[str, float]],
) -> Data:
    name = model.joint(joint).name
    force = force_of(model, joint, _MOVES[kind], motors)
    armature, is_light = armature_of(model, joint, force)
    if is_light:
        light.append((name, armature))
    home = started.start.get(name, model.joint(joint).qpos0)[0]
    settings: Data = {
        "speed": _speed(model, name, started.findings) or SPEED[_MOVES[kind]],
        "force": force,
        "home": float(home),
        "armature": armature,
    }
    if model.jnt_limited[joint]:
        settings["low"], settings["high"] = model.jnt_range[joint].tolist()
    return settings


def _boards(model: Any, findings: list[Finding]) -> dict[int, str]:
    """The board of joints in a tuple, in its order; a joint belongs to its first tuple."""
    found: dict[int, str] = {}
    for i in range(model.ntuple):
        first, size = int(model.tuple_adr[i]), int(model.tuple_size[i])
        for at in range(first, first + size):
            if int(model.tuple_objtype[at]) != int(mujoco.mjtObj.mjOBJ_JOINT):
                continue
            joint, name = int(model.tuple_objid[at]), model.tuple(i).name
            board = found.setdefault(joint, name)
            if board != name:
                message = (
                    f"`{model.joint(joint).name}` is in `{name}` and stays on the board `{board}`"
                )
                findings.append(model_finding("joint", model.joint(joint).name, message))
    return found


def couplings_of(model: Any, devices: Sequence[Data], findings: list[Finding]) -> Data:
    """The coupling matrix of each board in the file, as a list of numbers."""
    boards = Counter(device["settings"]["board"] for device in devices if device["kind"] in JOINTS)
    found: Data = {}
    for board, n in boards.items():
        name = f"coupling_{board}"
        if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name) < 0 or not board:
            continue
        numbers = model.numeric(name).data
        fits = len(numbers) == n * n and np.isfinite(numbers).all()
        if fits and np.linalg.matrix_rank(numbers.reshape(n, n)) == n:
            found[board] = numbers.tolist()
            continue
        message = f"`{name}` is no {n} x {n} matrix that can be turned round: it is left out"
        findings.append(model_finding("joint", "", message))
    return found


def _speed(model: Any, joint: str, findings: list[Finding]) -> float:
    """The maximum speed in the file; 0 if there is none."""
    name = f"speed_{joint}"
    at = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name)
    if at < 0:
        return 0.0
    speed = float(model.numeric(name).data[0])
    if 0 < speed < math.inf:
        return speed
    findings.append(
        model_finding("joint", joint, f"`{name}` is {speed:g}, no speed: the usual is taken")
    )
    return 0.0


def _few(names: list[str]) -> str:
    """The first of several devices."""
    more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
    return ", ".join(names[:_MOST_NAMED]) + more

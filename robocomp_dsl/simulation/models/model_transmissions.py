"""Boards of a model file whose joints differ from the model's: eyes by version and vergence.

In: the compiled model, the joints on its boards. Out: the same devices under the board's joint
names, and the matrices between the two:

    <custom>
      <text name="joints_head" data="eyes_tilt eyes_version eyes_vergence"/>
      <numeric name="transmission_head" data="1 0 0  0 1 0.5  0 1 -0.5"/>
      <numeric name="range_eyes_version" data="-0.5 0.5"/>
    </custom>

gives the names of the n joints of a board in the order of its tuple; the model's joint angles are
the matrix, n · n numbers row by row, times the board's joint angles. `range` are limits in rad.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.description.scene import JOINTS
from robocomp_dsl.simulation.models.model_texts import texts_of

PREFIX = "joints_"

Data = dict[str, Any]


def transmissions_of(model: Any, devices: Sequence[Data], findings: list[Finding]) -> Data:
    """The transmission matrix of each board in the file; also renames its joints."""
    found: Data = {}
    for text, names in texts_of(model).items():
        if not text.startswith(PREFIX):
            continue
        board = text.removeprefix(PREFIX)
        here = [d for d in devices if d["kind"] in JOINTS and d["settings"]["board"] == board]
        matrix = _numbers(model, f"transmission_{board}")
        if why := _wrong(here, devices, names, matrix):
            findings.append(model_finding("joint", "", f"`{text}` {why}: it is left out"))
            continue
        found[board] = matrix.tolist()
        for device, name in zip(here, names, strict=True):
            if name != device["id"]:
                _rename(model, device, name)
    return found


def _rename(model: Any, device: Data, name: str) -> None:
    """A joint of the board; the motor belongs to the model's joint."""
    settings = device["settings"]
    settings["joint"], device["id"] = device["id"], name
    settings.pop("low", None)
    settings.pop("high", None)
    limits = _numbers(model, f"range_{name}")
    if len(limits) == 2 and limits[0] < limits[1]:
        settings["low"], settings["high"] = limits.tolist()


def _wrong(
    here: Sequence[Data],
    devices: Sequence[Data],
    names: Sequence[str],
    matrix: np.ndarray[Any, np.dtype[np.float64]],
) -> str:
    """Why names and matrix do not fit this board; empty if they do."""
    n = len(here)
    if not n:
        return "names joints of a board that is not there"
    others = {d["id"] for d in devices} - {d["id"] for d in here}
    if len(names) != n or len(set(names)) != n or others & set(names):
        return f"must name the {n} joints of the board, each by a name of its own"
    if matrix.shape != (n * n,) or not np.isfinite(matrix).all():
        return f"needs a `transmission_…` of {n} x {n} numbers"
    if np.linalg.matrix_rank(matrix.reshape(n, n)) < n:
        return "has a transmission that cannot be turned round"
    return ""


def _numbers(model: Any, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """A list of numbers of the file, empty if it has none."""
    at = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name)
    return np.array(model.numeric(name).data if at >= 0 else [], float)

"""The initial state of a compiled model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco


def initial_data(model: Any, start: Mapping[str, float]) -> Any:
    """An `MjData` of `model` at its first key frame, if any, with its joints as in `start`.

    `start` maps names of hinges and slides to positions in rad or m; other joints are unchanged.
    """
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    for name, value in start.items():
        data.joint(name).qpos = value
    mujoco.mj_forward(model, data)
    return data

"""What stands in something else before time runs.

In: a compiled model, or a world in some state. Out: findings, the deepest first. Contacts are what
MuJoCo makes of the shapes: pairs that it leaves alone (a body and the one above it) are none.
"""

from __future__ import annotations

from typing import Any

import mujoco

from robocomp_dsl.hardware.findings import Finding
from robocomp_dsl.hardware.mujoco.mjcf_spec import located

_MOST = 10
_LEAST = 1e-4
"""m: what is less deep is how things stand on each other."""


def overlaps(model: Any) -> list[Finding]:
    """Bodies that are in each other at the start, at most ten pairs. Raises `ModelFileError`.

    The start is the first key frame, if there is one.
    """
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    try:
        mujoco.mj_forward(model, data)
    except mujoco.FatalError as error:
        raise located(error) from None
    return overlaps_of(model, data)


def overlaps_of(model: Any, data: Any) -> list[Finding]:
    """Bodies that are in each other as `data` has it, at most ten pairs."""
    deepest: dict[tuple[str, str], float] = {}
    for contact in data.contact:
        geoms = [int(geom) for geom in contact.geom if geom >= 0]
        one, other = sorted([*(_name(model, geom) for geom in geoms), "world"][:2])
        deepest[one, other] = min(deepest.get((one, other), 0.0), float(contact.dist))
    ordered = sorted(deepest.items(), key=lambda item: item[1])
    return [
        Finding("overlap", one, f"`{one}` and `{other}` are {-depth * 1000:.3g} mm in each other")
        for (one, other), depth in ordered[:_MOST]
        if depth < -_LEAST
    ]


def _name(model: Any, geom: int) -> str:
    """Of the body; what belongs to the world itself is called as its shape."""
    body = int(model.geom_bodyid[geom])
    name = model.body(body).name if body else model.geom(geom).name or "world"
    return name.removesuffix(".") or f"body{body}"

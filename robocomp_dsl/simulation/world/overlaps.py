"""Finds bodies that overlap.

In: a compiled model, or a world in some state. Out: findings, the deepest first. Based on MuJoCo's
contacts: pairs that it excludes (a body and its parent) are not reported.
"""

from __future__ import annotations

from typing import Any

import mujoco

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.simulation.models.mjcf_spec import error_with_line

_MOST = 10
_LEAST = 1e-4
"""m: smaller overlaps are normal contacts."""


def overlaps(model: Any) -> list[Finding]:
    """Bodies that overlap at the start, at most ten pairs. Raises `ModelFileError`.

    The start is the first key frame, if there is one.
    """
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    try:
        mujoco.mj_forward(model, data)
    except mujoco.FatalError as error:
        raise error_with_line(error) from None
    return current_overlaps(model, data)


def current_overlaps(model: Any, data: Any) -> list[Finding]:
    """Bodies that overlap in the state `data`, at most ten pairs."""
    deepest: dict[tuple[str, str], float] = {}
    for contact in data.contact:
        geoms = [int(geom) for geom in contact.geom if geom >= 0]
        first, other = sorted([*(_name(model, geom) for geom in geoms), "world"][:2])
        deepest[first, other] = min(deepest.get((first, other), 0.0), float(contact.dist))
    ordered = sorted(deepest.items(), key=lambda item: item[1])
    return [
        model_finding(
            "overlap", first, f"`{first}` and `{other}` overlap by {-depth * 1000:.3g} mm"
        )
        for (first, other), depth in ordered[:_MOST]
        if depth < -_LEAST
    ]


def _name(model: Any, geom: int) -> str:
    """The name of the body, or of the shape if it belongs to the world."""
    body = int(model.geom_bodyid[geom])
    name = model.body(body).name if body else model.geom(geom).name or "world"
    return name.removesuffix(".") or f"body{body}"

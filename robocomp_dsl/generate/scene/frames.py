"""Lower the frames of an InnerModel body: their poses, and how joints move them.

In: a frame and its parent. Out: JSON data for `hardware.description.scene.frame_of_data`; infinite
limits are left out.
"""

from __future__ import annotations

import math
from typing import Any

from robocomp_dsl.model import innermodel

Data = dict[str, Any]


def lower_frame(
    node: innermodel.Transform | innermodel.PrismaticJoint, parent: innermodel.Node
) -> Data:
    """The data of a frame in its parent."""
    frame: Data = {"id": node.id, "parent": parent.id}
    if isinstance(node, innermodel.PrismaticJoint):
        place = [0.0, 0.0, 0.0]
        place["xyz".index(node.axis)] = node.position + node.offset
        return frame | {"place": place, "motion": _motion(node, "slide", node.offset)}
    frame["place"] = [node.tx, node.ty, node.tz]
    frame["turn"] = [node.rx, node.ry, node.rz]
    if isinstance(node, innermodel.Joint):
        frame["motion"] = _motion(node, "hinge", 0.0)
    if node.mass > 0:
        frame["mass"] = node.mass
    return frame | {"drives": isinstance(node, innermodel.Base), "physics": node.engine == "bullet"}


def _motion(node: innermodel.Joint | innermodel.PrismaticJoint, kind: str, offset: float) -> Data:
    motion: Data = {"kind": kind, "axis": node.axis, "home": node.home, "offset": offset}
    limits: Data = {"low": node.min, "high": node.max}
    for child in node.children:
        if isinstance(child, innermodel.Motor):
            limits |= {"force": child.force, "gear": child.gear, "velocity": child.velocity}
    return motion | {name: value for name, value in limits.items() if math.isfinite(value)}

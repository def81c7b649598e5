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
    node: innermodel.Transform | innermodel.PrismaticJoint,
    parent: innermodel.Node,
    *,
    at_home: bool = True,
) -> Data:
    """The data of a frame in its parent.

    As in RoboComp, a joint starts at its `home` in a simulation (`at_home`), and at its own angle
    or position in the geometric model.
    """
    frame: Data = {"id": node.id, "parent": parent.id}
    if isinstance(node, innermodel.PrismaticJoint):
        start, home = _slide_start(node, at_home=at_home)
        place = [0.0, 0.0, 0.0]
        place["xyz".index(node.axis)] = start + node.offset
        return frame | {"place": place, "motion": _motion(node, "slide", home, node.offset)}
    frame["place"] = [node.tx, node.ty, node.tz]
    frame["turn"] = turn = [node.rx, node.ry, node.rz]
    if isinstance(node, innermodel.Joint):
        at = "xyz".index(node.axis)
        home = _within(node, turn[at] if node.home is None else node.home)
        if at_home and node.home is not None:
            turn[at] = home
        frame["motion"] = _motion(node, "hinge", home)
    if node.mass > 0:
        frame["mass"] = node.mass
    return frame | {"drives": isinstance(node, innermodel.Base), "physics": node.engine == "bullet"}


def _slide_start(node: innermodel.PrismaticJoint, *, at_home: bool) -> tuple[float, float]:
    """The initial position and the home of a slide; each is the default of the other."""
    position = node.position
    home = _within(node, (position or 0.0) if node.home is None else node.home)
    if position is None:
        position = home if at_home else 0.0
    return position, home


def _within(node: innermodel.Joint | innermodel.PrismaticJoint, value: float) -> float:
    """The value within the limits of the joint, if these contain anything."""
    return min(max(value, node.min), node.max) if node.min <= node.max else value


def _motion(
    node: innermodel.Joint | innermodel.PrismaticJoint, kind: str, home: float, offset: float = 0.0
) -> Data:
    motion: Data = {"kind": kind, "axis": node.axis, "home": home, "offset": offset}
    limits: Data = {"low": node.min, "high": node.max}
    for child in node.children:
        if isinstance(child, innermodel.Motor):
            motor = {"force": child.force, "gear": child.gear, "velocity": child.velocity}
            limits |= {name: value for name, value in motor.items() if value > 0}
    return motion | {name: value for name, value in limits.items() if math.isfinite(value)}

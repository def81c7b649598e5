"""Where a finger of a simulated robot has to be to touch a field, in the state of a model."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.model import GenericPart
from robocomp_dsl.tactile.reflex.law import Field

FINGERS = ("finger", "finger2")
CLEAR = 0.055
"""Outside every limb, and nearer to its axis than anything else of the robot [m]."""


def slides(finger: str) -> list[str]:
    return [f"{finger}_{axis}" for axis in "xyz"]


def point(data: Any, finger: str) -> Floats:
    """Where the centre of a finger is in the world."""
    place: Floats = data.geom(finger).xpos.copy()
    return place


def inwards(data: Any, part: GenericPart, field: Field) -> Floats:
    """The way into the limb at the field's centre, of length 1, in the world."""
    limb = part.limb(field.limb)
    out = np.array([0.0, *field.centre[1:]])
    return -data.body(limb.body).xmat.reshape(3, 3) @ limb.axes @ (out / np.linalg.norm(out))


def before_skin(
    model: Any,
    data: Any,
    part: GenericPart,
    field: Field,
    off: float,
    along: float = 0.0,
    finger: str = FINGERS[0],
) -> Floats:
    """Where a finger's centre is when it is `off` before the skin.

    At the field's centre, or so far along the limb.
    """
    limb, way = part.limb(field.limb), inwards(data, part, field)
    body = data.body(limb.body)
    axis = np.array([field.centre[0] + along, 0.0, 0.0])
    start = body.xpos + body.xmat.reshape(3, 3) @ limb.to_body(axis) - CLEAR * way
    geom, ball = np.zeros(1, np.int32), model.geom(finger)
    far = mujoco.mj_ray(model, data, start, way, None, 1, int(ball.bodyid[0]), geom)
    return start + (far - float(ball.size[0]) - off) * way

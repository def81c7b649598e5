"""The taxels that no receptive field contains: touches there move nothing.

In: a description. Out: a finding for each limb with many such taxels, with their share.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.tactile.arrays import Bools
from robocomp_dsl.tactile.description.model import GenericPart, Limb, RobotDescription
from robocomp_dsl.tactile.errors import Fault

MAX_UNANSWERED = 0.1
"""The share of the taxels of a limb that may be between its fields."""


def unanswered_taxels(robot: RobotDescription) -> list[Finding]:
    """The findings of all limbs; a part without fields has no reflex, and none is needed."""
    return [
        finding
        for part in robot.parts
        if part.fields
        for limb in part.limbs
        for finding in [_find(limb, part)]
        if finding
    ]


def covered(limb: Limb, part: GenericPart) -> Bools:
    """Whether a field of `part` contains each taxel of `limb`, (n,), in the order of patches."""
    skin = [patch.points for patch in part.patches if patch.limb == limb.name]
    points = np.concatenate(skin) if skin else np.zeros((0, 3))
    inside = np.zeros(len(points), bool)
    for field in part.fields:
        if field.limb == limb.name:
            inside |= np.linalg.norm(points - field.centre, axis=1) < field.radius
    return inside


def _find(limb: Limb, part: GenericPart) -> Finding | None:
    inside = covered(limb, part)
    count = int((~inside).sum())
    share = count / max(len(inside), 1)
    if share <= MAX_UNANSWERED:
        return None
    message = (
        f"{count} of {len(inside)} taxels of `{limb.name}` ({share:.0%}) are in no field:"
        " touches there move nothing"
    )
    places = [patch.place for patch in part.patches if patch.limb == limb.name]
    help_text = "add `fields`, or enlarge their radius"
    return Finding(places[0], message, help=help_text, kind=Fault.UNANSWERED)

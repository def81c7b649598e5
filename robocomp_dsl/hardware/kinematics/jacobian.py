"""Motion of a point with the joints that carry it.

In: a tree of frames, joints and a point. Out: the geometric Jacobian (Siciliano et al., Robotics:
Modelling, Planning and Control, section 3.1).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robocomp_dsl.hardware.description.scene import ROOT, Triple
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.hardware.kinematics.transforms import TransformTree

_ORIGIN: Triple = (0.0, 0.0, 0.0)


def jacobian(
    tree: TransformTree,
    joints: Sequence[str],
    tip: str,
    *,
    base: str = ROOT,
    point: Triple = _ORIGIN,
) -> Matrix:
    """Translation and rotation of `point` of the frame `tip` in `base`; shape (6, joints).

    Rows are x, y, z in mm and the rotation about x, y, z in rad; columns are per rad of a hinge and
    per mm of a slide. A joint that does not carry `tip` has a column of zeros. `base` is considered
    fixed. Raises `FrameError`.
    """
    matrix = np.zeros((6, len(joints)))
    end = np.array(tree.transform(point, tip, base))
    carrying = tree.path(tip)
    for column, joint in enumerate(joints):
        hinge = tree.motion(joint).kind == "hinge"
        if joint not in carrying:
            continue
        axis = tree.axis(joint, base)
        if hinge:
            matrix[:3, column] = np.cross(axis, end - tree.transform(_ORIGIN, joint, base))
            matrix[3:, column] = axis
        else:
            matrix[:3, column] = axis
    return matrix

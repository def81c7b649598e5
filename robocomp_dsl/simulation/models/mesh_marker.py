"""Markers in place of meshes that cannot be shown.

In: a body of an `MjSpec` and a point. Out: a site, which has no mass, touches nothing and is seen
neither by rays nor by simulated cameras; the view draws it without framing it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

MARKER_SIZE = 0.02
"""m: edge of a marker."""
MARKER_COLOUR = (0.9, 0.4, 0.2, 1.0)

_LEAST_SHARE, _MOST_SHARE = 0.006, 0.03

_NAME = "missing mesh "
_UNSEEN_GROUP = 5
"""A group of sites that no camera shows."""


def add_marker(body: Any, name: str, pos: Sequence[float] | NDArray[np.float64]) -> None:
    """Mark the place of the mesh `name`, at `pos` in the body, in m."""
    body.add_site(
        name=f"{_NAME}{name}",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=pos,
        size=[MARKER_SIZE / 2] * 3,
        rgba=MARKER_COLOUR,
        group=_UNSEEN_GROUP,
    )


def marker_size(extent: float) -> float:
    """m: the edge of a marker in a view of so many m: visible in a large world, small in any."""
    return min(max(MARKER_SIZE, extent * _LEAST_SHARE), extent * _MOST_SHARE)


def is_marker(name: str) -> bool:
    """Whether a site of this name is a marker."""
    return name.startswith(_NAME)


def marked_meshes(model: Any) -> dict[int, str]:
    """The names of the marked meshes by the index of their site."""
    names = {i: model.site(i).name for i in range(model.nsite)}
    return {i: name.removeprefix(_NAME) for i, name in names.items() if is_marker(name)}

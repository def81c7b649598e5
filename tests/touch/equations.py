"""What a field has to answer to one touch, worked out apart from the library (equations 5 to 7)."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.tactile.arrays import Floats


def mean_force_and_distance(
    points: Floats, forces: Floats, centre: Floats, radius: float
) -> tuple[float, float]:
    """Weighted mean force, and distance of the weighted centre, of taxels within a diameter."""
    middle = (forces[:, None] * points).sum(0) / forces.sum()
    weights = 2 * radius - np.sqrt(((points - middle) ** 2).sum(1))
    assert (weights > 0).all()
    mean = (forces * weights).sum() / weights.sum()
    return float(mean), float(np.sqrt(((middle - centre) ** 2).sum()))


def gain(
    points: Floats, forces: Floats, centre: Floats, radius: float, threshold: float, full: float
) -> float:
    """Between 0 and 1: force and distance discount the base motion, as the text has them."""
    force, distance = mean_force_and_distance(points, forces, centre, radius)
    phi = np.clip((force - threshold) / (full - threshold), 0, 1)
    return float(phi * max(1 - distance / radius, 0.0))

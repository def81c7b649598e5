"""Plans a path of the finger around the robot.

In: a distance function, a start and a goal. Out: waypoints, joined by straight lines, all of which
keep their distance from the robot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise, product

import numpy as np
from recording import Floats

Clearance = Callable[[Floats], float]

_STEP = 0.01
_DETOURS = (0.12, 0.25, 0.4)


class NoPath(Exception):
    """No path of the finger avoids contact with other objects."""


def plan_path(
    clearance: Clearance, start: Floats, goal: Floats, margin: float = 0.008
) -> list[Floats]:
    """The waypoints after `start` up to `goal`: the shortest path found with at most two bends.

    Near its ends the path may be as close to the robot as the ends are. Raises `NoPath`.
    """
    found = sorted(_candidate_paths(start, goal), key=lambda points: _length([start, *points]))
    least = min(margin, 0.9 * clearance(start), 0.9 * clearance(goal))
    for points in found:
        if all(clearance(point) >= least for point in _along([start, *points])):
            return points
    raise NoPath("the finger finds no path to the next place that touches nothing else")


def _candidate_paths(start: Floats, goal: Floats) -> Iterator[list[Floats]]:
    """Direct, with a detour at the goal, and with detours at both ends."""
    yield [goal]
    sides = [
        np.array(direction, float) for direction in product((-1, 0, 1), repeat=3) if any(direction)
    ]
    for far, side in product(_DETOURS, sides):
        aside = goal + far * side / np.linalg.norm(side)
        yield [aside, goal]
        for other in (start + far * side / np.linalg.norm(side) for side in sides):
            yield [other, aside, goal]


def _length(points: list[Floats]) -> float:
    return sum(float(np.linalg.norm(after - before)) for before, after in pairwise(points))


def _along(points: list[Floats]) -> Iterator[Floats]:
    for before, after in pairwise(points):
        steps = max(2, int(np.linalg.norm(after - before) / _STEP))
        yield from np.linspace(before, after, steps)

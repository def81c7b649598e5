import random
from types import SimpleNamespace

import numpy as np
import pytest

from tests.demo.component_modules import load

reaction = load("wander/reaction.py")
Turning = reaction.Turning

LIMITS = SimpleNamespace(
    threshold=600, front=0.8, advance=400, turn=1.0, turn_min=500, turn_max=900, side="freer"
)
ANGLES = np.linspace(-2, 2, 81, dtype=np.float32)


def scan(**near: float) -> np.ndarray:
    """Everything at 4 m, and something at `near` mm to the left, ahead, to the right or behind."""
    distances = np.full(81, 4000, dtype=np.float32)
    for side, distance in near.items():
        middle = {"left": -0.5, "ahead": 0.0, "right": 0.5, "beside": 1.5}[side]
        distances[np.abs(ANGLES - middle) < 0.2] = distance
    return distances


@pytest.mark.parametrize(
    ("near", "turning", "now", "adv", "rot"),
    [
        ({}, None, 0.0, 400, 0),
        ({"ahead": 601}, None, 0.0, 400, 0),
        ({"beside": 200}, None, 0.0, 400, 0),  # not in the way
        ({"left": 500}, None, 0.0, 0, 1.0),  # more room to the right
        ({"right": 500}, None, 0.0, 0, -1.0),
        ({}, Turning(-1, 5.0), 4.9, 0, -1.0),  # its time is not over
        ({"ahead": 500}, Turning(-1, 5.0), 5.1, 0, -1.0),  # the way is not free
        ({"right": 500}, Turning(1, 5.0), 5.1, 0, 1.0),  # it does not change sides
        ({}, Turning(-1, 5.0), 5.1, 400, 0),
    ],
)
def test_reaction_decides_by_nearest_obstacle(
    near: dict, turning: object, now: float, adv: float, rot: float
) -> None:
    found = reaction.decide(ANGLES, scan(**near), now, turning, it=LIMITS, chance=random.Random(1))
    assert (found.adv, found.rot) == (adv, rot)
    assert (found.turning is None) == (rot == 0)


def test_reaction_turn_lasts_within_limits() -> None:
    chance = random.Random(1)
    ends = [
        reaction.decide(ANGLES, scan(ahead=100), 10.0, None, it=LIMITS, chance=chance).turning.until
        for _ in range(200)
    ]
    assert 10.5 <= min(ends) < 10.6
    assert 10.8 < max(ends) <= 10.9


def test_reaction_takes_both_random_sides() -> None:
    limits = SimpleNamespace(**vars(LIMITS) | {"side": "random"})
    chance = random.Random(1)
    sides = {
        reaction.decide(ANGLES, scan(left=100), 0.0, None, it=limits, chance=chance).turning.sense
        for _ in range(40)
    }
    assert sides == {-1, 1}


def test_reaction_ignores_laser_without_front_rays() -> None:
    found = reaction.decide(ANGLES[:5], scan()[:5], 0.0, None, it=LIMITS, chance=random.Random(1))
    assert found.adv == 400
    assert found.nearest == float("inf")

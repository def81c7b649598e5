"""The acceptance table of the reflex at the component's ports: frames in, commands to the arm out.

First with the table's own numbers on a skin of single taxels, then with the taxels of the real
descriptions. What is expected is worked out here from equations 5 to 7, apart from the library.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from tests.touch.equations import gain
from tests.touch.kinematic_robot import ARMS, CentredRobot, ReflexHarness, interfaces

THETA = np.array([-0.2, 0.3, 0.0, 0.5, 0.1])
CENTRE = np.array([0.05, 0.0, 0.03])
RADIUS = 0.03
FORCES = {
    "threshold": 1.0,
    "full": 10.0,
    "least_change": 0.0005,
    "withdraw_speed": 1.0,
    "law": "fixed",
}
TOLERANCE = 1e-6

Rows = list[tuple[float, float, float]]
TABLE: list[tuple[str, Rows, Floats]] = [
    ("1 centre, full force", [(0.05, 0, 10)], THETA),
    ("2 half the force", [(0.05, 0, 5.5)], np.array([-0.1, 0.15, 0, 0.25, 0.05])),
    ("3a half the way", [(0.065, 0, 10)], 0.5 * THETA),
    ("3b half of both", [(0.065, 0, 5.5)], 0.25 * THETA),
    ("3c around the limb", [(0.05, np.pi / 6, 10)], 0.482362 * THETA),
    ("4a on the edge", [(0.08, 0, 10)], 0 * THETA),
    ("4b inside the edge", [(0.0797, 0, 10)], 0.01 * THETA),
    ("5a at the threshold", [(0.05, 0, 1.0)], 0 * THETA),
    ("5b above the threshold", [(0.05, 0, 1.09)], 0.01 * THETA),
    ("6 more than full", [(0.05, 0, 20)], THETA),
    ("7 two taxels", [(0.045, 0, 2), (0.055, 0, 6)],
     np.array([-0.062963, 0.094444, 0, 0.157407, 0.031481])),
    ("8 two touches, opposite", [(0.05, 0, 10), (0.05, np.pi, 10)], THETA),
    ("9 a weak taxel far off", [(0.05, 0, 10), (0.20, 0, 1.5)], THETA),
]  # fmt: skip


def place(x: float, theta: float) -> tuple[float, float, float]:
    """On the cone of the table."""
    return x, RADIUS * np.sin(theta), RADIUS * np.cos(theta)


class TableSkin(CentredRobot):
    """A skin of the table's taxels alone, on the lower arm of the real description."""

    def initialize(self) -> None:
        super().initialize()
        places = list(dict.fromkeys(row[:2] for _, rows, _ in TABLE for row in rows))
        points = np.array([place(*system) for system in places])
        limb = self.geometry.limbs.index(f"{self.side}/lower_arm")
        n = len(points)
        self.geometry = replace(
            self.geometry,
            ids=np.arange(n),
            patch=np.zeros(n, int),
            limb=np.full(n, limb),
            points=points,
            normals=np.tile([0.0, 0.0, 1.0], (n, 1)),
        )
        self.forces = np.zeros(n)
        self.places = places

    def touch(self, rows: Rows) -> None:
        for x, theta, force in rows:
            self.forces[self.places.index((x, theta))] = force


@pytest.fixture
def start_table_reflex(
    start_reflex: Callable[..., ReflexHarness],
) -> Callable[..., ReflexHarness]:
    """Starts a reflex with the forces of the table."""

    def start(*arguments: object, **params: object) -> ReflexHarness:
        return start_reflex(*arguments, **{**FORCES, **params}).wait_until_watching()

    return start


@pytest.mark.parametrize(("rows", "motion"), [r[1:] for r in TABLE], ids=[r[0] for r in TABLE])
@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_reflex_matches_acceptance_table(start_table_reflex, robot, side, rows, motion) -> None:
    harness = start_table_reflex(robot, side, TableSkin)
    limb = f"{side}/lower_arm"
    harness.reflex.setFields([interfaces.Field("bottom", limb, *CENTRE.tolist(), RADIUS, THETA)])
    start = harness.robot.pose
    harness.robot.touch(rows)
    harness.run(0.02)
    harness.robot.forces[:] = 0.0
    harness.run(0.3)
    if not motion.any():
        assert harness.robot.moves == []
        assert (harness.robot.pose == start).all()
        return
    assert harness.robot.moves[0][1] - start == pytest.approx(motion, abs=TOLERANCE)
    assert harness.robot.pose - start == pytest.approx(motion, abs=TOLERANCE)  # it went there
    assert harness.reflex.getStatistics().withdrawals == 1


# The same on the real skins: every field of the description, at its own taxels.


class OwnSkin:
    """The taxels of one field's limb, from its centre outwards."""

    def __init__(self, harness: ReflexHarness, name: str) -> None:
        self.harness, self.field = harness, harness.field(name)
        geometry: SkinGeometry = harness.robot.geometry
        limb = geometry.limbs.index(f"{harness.robot.side}/{self.field.limb}")
        mine = np.flatnonzero(geometry.limb == limb)
        away = np.linalg.norm(geometry.points[mine] - self.field.centre, axis=1)
        self.taxels = mine[np.argsort(away)]
        self.points = geometry.points.astype(np.float32).astype(float)  # as they are told

    def at(self, distance: float) -> int:
        """The taxel whose distance from the centre is nearest to this."""
        away = np.linalg.norm(self.points[self.taxels] - self.field.centre, axis=1)
        return int(self.taxels[np.argmin(np.abs(away - distance))])

    def beside(self, taxel: int) -> int:
        """Its nearest neighbour."""
        away = np.linalg.norm(self.points[self.taxels] - self.points[taxel], axis=1)
        return int(self.taxels[np.argsort(away)[1]])

    def opposite(self) -> int:
        """The taxel on the other side of the limb."""
        x, y, z = self.field.centre
        away = np.linalg.norm(self.points[self.taxels] - [x, -y, -z], axis=1)
        return int(self.taxels[np.argmin(away)])

    def expected(self, *taxels: tuple[int, float]) -> float:
        index, forces = np.array([t for t, _ in taxels]), np.array([f for _, f in taxels])
        return gain(self.points[index], forces, self.field.centre, self.field.radius, 1.0, 10.0)

    def answer(self, *taxels: tuple[int, float]) -> float:
        """The gain of this field when these taxels feel so much: what the arm was told to do."""
        robot = self.harness.robot
        start, count = robot.pose, len(robot.moves)
        for taxel, force in taxels:
            robot.forces[taxel] = force
        self.harness.run(0.02)
        robot.forces[:] = 0.0
        if len(robot.moves) == count:
            return 0.0
        self.harness.run_until("Watching")
        self.harness.run(0.3)  # the last hundredths of a rad
        moved = robot.moves[count][1] - start
        largest = int(np.argmax(np.abs(self.field.motion)))
        share = moved[largest] / self.field.motion[largest]
        assert moved == pytest.approx(share * self.field.motion, abs=TOLERANCE)
        return float(share)


PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip


def case(skin: OwnSkin, number: str) -> tuple[tuple[tuple[int, float], ...], float]:
    """What is harness in each row of the table, and the gain that belongs to it."""
    centre, half, edge = skin.at(0.0), skin.at(0.0175), skin.at(0.034)
    beside, beyond = skin.beside(centre), skin.at(0.05)
    contact: tuple[tuple[int, float], ...] = {
        "1": ((centre, 10.0),),
        "2": ((centre, 5.5),),
        "3a": ((half, 10.0),),
        "3b": ((half, 5.5),),
        "4a": ((beyond, 10.0),),
        "4b": ((edge, 10.0),),
        "5a": ((centre, 1.0),),
        "5b": ((centre, 1.09),),
        "6": ((centre, 20.0),),
        "7": ((centre, 2.0), (beside, 6.0)),
        "8": ((centre, 10.0), (skin.opposite(), 10.0)),
        "9": ((centre, 10.0), (beyond, 1.5)),
    }[number]
    first = contact[:1] if number in ("8", "9") else contact  # the others are touches of their own
    return contact, skin.expected(*first)


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_reflex_matches_acceptance_table_on_real_taxels(
    start_table_reflex, robot, side, name
) -> None:
    harness = start_table_reflex(
        robot, side, CentredRobot, refractory=0.0, hold=0.02, return_speed=1.0
    )
    skin = OwnSkin(harness, name)
    harness.reflex.setFields([f for f in harness.reflex.getFields() if f.name == name])
    for number in ("1", "2", "3a", "3b", "4a", "4b", "5a", "5b", "6", "7", "8", "9"):
        taxels, expected = case(skin, number)
        found = skin.answer(*taxels)
        assert found == pytest.approx(expected, abs=1e-5), number
        if number in ("4a", "5a"):
            assert found == 0.0
        elif number in ("4b", "5b"):
            assert 0.0 < found < 0.3
        else:
            assert found > 0.05, number

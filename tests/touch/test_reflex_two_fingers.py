"""Two touches at once, and touches that no field is for: on the shipped robots and components.

Rows 8 and 9 of the acceptance table, with the forces that physics makes. What is expected is worked
out by `equations`, for each touch alone; what one mean of both touches would say must not happen.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Field
from tests.touch import finger_geometry
from tests.touch.equations import gain
from tests.touch.kinematic_robot import interfaces
from tests.touch.shipped_system import BOARDS, ShippedSystem

OUTER, UNDER, FRONT = "lower_arm_outer", "lower_arm_under", "upper_arm_front"
OTHER = finger_geometry.FINGERS[1]
FULL = 0.2


@pytest.fixture(scope="module", params=list(BOARDS), ids=[f"{r}-{s}" for r, s in BOARDS])
def robot(request: pytest.FixtureRequest) -> Iterator[ShippedSystem]:
    system = ShippedSystem(*request.param, hold=0.2, law="fixed")
    try:
        system.run_until("Watching", 5.0)
        yield system
    finally:
        system.close()


@pytest.fixture
def system(robot: ShippedSystem) -> Iterator[ShippedSystem]:
    """At rest in its start pose, with the fields that it ships with."""
    fields = robot.reflex.getFields()
    robot.reflex.setForces(0.0, FULL)
    yield robot
    robot.remove_fingers()
    robot.reflex.setFields(fields)
    robot.reflex.enable(True)
    robot.params(withdraw_speed=0.45)
    robot.run(0.1)
    robot.run_until("Watching")
    robot.run(1.0)  # the refractory time


def set_field(system: ShippedSystem, field: Field) -> None:
    limb = f"{system.side}/{field.limb}"
    message = interfaces.Field(field.name, limb, *field.centre.tolist(), field.radius, field.motion)
    system.reflex.setFields([message])


def field_at(system: ShippedSystem, name: str, x: float, radius: float) -> Field:
    """A field as wide as this at another place along the limb of `name`, on its cone."""
    field = system.field(name)
    cone = system.part.limb(field.limb).cone
    out = field.centre[1:] / np.linalg.norm(field.centre[1:])
    centre = np.array([x, *(float(cone.radius(x)) * out)])
    return Field("f", field.limb, centre, radius, field.motion)


def answer(system: ShippedSystem) -> Any:
    """To what presses meanwhile for so long that it has come to rest; None: nothing answers."""
    known = len(system.events())
    system.run(0.3)
    assert len(system.events()) == known, "it was disabled"
    system.reflex.enable(True)
    system.run(0.04)
    events = system.events()[known:]
    return events[0] if events else None


def pressed_taxels(system: ShippedSystem, event: Any) -> tuple[Floats, Floats]:
    """Points (k, 3) and forces (k,) of the taxels of the limb that felt something."""
    geometry = system.world.simulation.skin.geometry
    force = system.world.frames[event.time].astype(np.float32).astype(float)
    index = np.flatnonzero((force > 0) & (geometry.limb == geometry.limbs.index(event.limb)))
    return geometry.points[index], force[index]


def test_reflex_counts_fingers_on_both_sides_as_two_touches(system: ShippedSystem) -> None:
    """Row 8: one mean of both lies inside the limb, where no field would answer."""
    system.reflex.enable(False)
    count, field = system.reflex.getStatistics().withdrawals, system.field(OUTER)
    set_field(system, field)
    system.press(field, 0.002)
    system.press(system.field("lower_arm_inner"), 0.002, finger=OTHER)
    events = answer(system)
    points, forces = pressed_taxels(system, events)
    mine = points @ np.array([0.0, *field.centre[1:]]) > 0.0
    assert forces[mine].sum() > 0.3
    assert forces[~mine].sum() > 0.3
    alone = gain(points[mine], forces[mine], field.centre, field.radius, 0.0, FULL)
    assert events.gain == pytest.approx(alone, abs=1e-5)
    assert events.motion == pytest.approx(alone * field.motion, abs=1e-5)
    together = forces @ points / forces.sum()
    assert np.linalg.norm(together - field.centre) > 0.6 * field.radius
    assert events.distance < 0.3 * field.radius
    assert system.reflex.getStatistics().withdrawals == count + 1


def test_reflex_response_is_unchanged_by_touch_elsewhere_on_limb(system: ShippedSystem) -> None:
    """Row 9: the second finger presses the same limb beyond the field, at the same time."""
    system.reflex.enable(False)
    count, cone = system.reflex.getStatistics().withdrawals, system.part.limb("lower_arm").cone
    field = field_at(system, OUTER, cone.x0 + 0.01, 0.02)
    set_field(system, field)
    system.press(field, 0.003)
    system.press(field_at(system, OUTER, cone.x1 - 0.01, 0.02), 0.003, finger=OTHER)
    events = answer(system)
    points, forces = pressed_taxels(system, events)
    mine = points[:, 0] < (cone.x0 + cone.x1) / 2
    assert forces[mine].sum() > 0.3
    assert forces[~mine].sum() > 0.3
    alone = gain(points[mine], forces[mine], field.centre, field.radius, 0.0, FULL)
    assert events.gain == pytest.approx(alone, abs=1e-5)
    together = forces @ points / forces.sum()
    assert np.linalg.norm(together - field.centre) > field.radius  # no field would answer
    assert events.distance < 0.5 * field.radius
    assert system.reflex.getStatistics().withdrawals == count + 1


def test_reflex_ignores_finger_outside_fields(system: ShippedSystem) -> None:
    """With a field in front of the upper arm only: nobody watches its back."""
    fields = system.reflex.getFields()
    system.reflex.setFields([field for field in fields if field.name == FRONT])
    count, start = system.reflex.getStatistics().withdrawals, system.arm.getState().position
    front = system.field(FRONT)
    back = Field("back", front.limb, front.centre * (1.0, -1.0, -1.0), 0.01, front.motion)
    system.press(back, 0.003)
    felt = []
    for _ in range(25):
        system.run(0.02)
        felt.append(system.total_force())
        assert system.state == "Watching"
    assert max(felt) > 0.3
    assert felt[-1] > 0.1  # it still presses
    assert system.reflex.getStatistics().withdrawals == count
    assert system.arm.getState().position == pytest.approx(start, abs=0.05)
    system.reflex.setFields(fields)


def test_reflex_withdraws_by_both_fields_from_two_fingers(system: ShippedSystem) -> None:
    system.reflex.enable(False)
    count = system.reflex.getStatistics().withdrawals
    fields = [system.field(name) for name in (UNDER, FRONT)]
    for field, finger in zip(fields, finger_geometry.FINGERS, strict=True):
        system.press(field, 0.003, finger=finger)
    assert answer(system) is not None
    held, limits = system.worker(1).withdrawal, system.arm.getLimits()
    assert set(held.strongest) >= {UNDER, FRONT}
    motion = sum(response.motion for response in held.strongest.values())
    assert held.goal == pytest.approx(np.clip(held.origin + motion, limits.low, limits.high))
    system.run(0.5)
    assert system.reflex.getStatistics().withdrawals == count + 1


def test_reflex_adds_second_finger_during_withdrawal(system: ShippedSystem) -> None:
    system.reflex.setForces(0.005, 0.02)
    system.params(withdraw_speed=0.05)
    system.press(system.field(OUTER), 0.003)
    system.run_until("Withdrawing", 1.0)
    held, count = system.worker(1).withdrawal, system.reflex.getStatistics().withdrawals
    assert FRONT not in held.strongest
    system.press(system.field(FRONT), 0.004, finger=OTHER)
    system.run(0.3)
    more = system.worker(1).withdrawal
    assert FRONT in more.strongest
    assert np.abs(more.goal - held.goal).max() > 0.05
    assert system.reflex.getStatistics().withdrawals == count

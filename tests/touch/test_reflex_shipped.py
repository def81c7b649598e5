"""Simulator, generic_arm and reflex as they are shipped: the finger presses, the arm withdraws.

The same folder `reflex` on both robots and both arms; what differs are two parameters and a wire.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from tests.touch.equations import gain
from tests.touch.shipped_system import BOARDS, ShippedSystem

PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip


@pytest.fixture(scope="module", params=list(BOARDS), ids=[f"{r}-{s}" for r, s in BOARDS])
def system(request: pytest.FixtureRequest) -> Iterator[ShippedSystem]:
    system = ShippedSystem(*request.param, threshold=0.005, full=0.02, hold=1.0, law="fixed")
    try:
        system.run_until("Watching", 5.0)
        system.run(0.5)
        yield system
    finally:
        system.close()


def test_shipped_reflex_withdraws_from_finger_and_returns(system: ShippedSystem) -> None:
    for place in PLACES:
        field, start = system.field(place), system.arm.getState().position
        before, count = system.spot(field), system.reflex.getStatistics().withdrawals
        system.press(field, 0.004)
        felt = acted = cleared = 0.0
        for _ in range(40):
            system.run(0.02)
            now = system.world.clock.now()
            felt = felt or (now if system.total_force() > 0 else 0.0)
            acted = acted or (now if system.state == "Withdrawing" else 0.0)
            cleared = now if system.total_force() > 0 else cleared
        assert felt, place
        assert 0.0 < acted - felt + 0.02 <= 0.0801, place  # frames come every 20 ms
        assert place in system.worker(1).withdrawal.strongest
        assert np.linalg.norm(system.spot(field) - before) > 0.01, place
        assert cleared - felt < 0.6, place
        assert system.total_force() == 0.0, place  # the finger is still there, the arm is not
        assert system.reflex.getStatistics().withdrawals == count + 1
        system.remove_fingers()
        system.run_until("Watching")
        system.run(0.5)
        assert system.arm.getState().position == pytest.approx(start, abs=0.03), place
    assert_within_limits(system)


def test_shipped_reflex_ignores_touch_below_threshold_and_outside_fields(
    system: ShippedSystem,
) -> None:
    fields = system.reflex.getFields()
    count = system.reflex.getStatistics().withdrawals
    start = system.arm.getState().position
    system.reflex.setForces(20.0, 30.0)
    system.press(system.field("lower_arm_under"), 0.002)
    peak = 0.0
    for _ in range(20):
        system.run(0.02)
        peak = max(peak, system.total_force())
    assert peak > 0.1
    system.remove_fingers()
    system.reflex.setForces(0.005, 0.02)
    system.reflex.setFields([field for field in fields if field.name == "upper_arm_front"])
    system.press(system.field("lower_arm_under"), 0.002)
    system.run(0.4)
    system.remove_fingers()
    system.run(0.1)
    system.reflex.setFields(fields)
    seen = system.reflex.getStatistics()
    assert seen.withdrawals == count
    assert system.arm.getState().position == pytest.approx(start, abs=0.05)
    bad = (seen.framesNotFinite, seen.framesWrongLength, seen.framesOutOfOrder)
    assert bad == (0, 0, 0)
    assert seen.framesOtherGeometry == 0


def test_shipped_reflex_responses_match_equations(system: ShippedSystem) -> None:
    """The forces that physics makes, through the simulated skin; a little off the centre."""
    system.run_until("Watching")
    system.run(1.0)
    known, geometry = len(system.events()), system.world.simulation.skin.geometry
    system.reflex.setForces(0.0, 0.5)
    system.press(system.field("lower_arm_outer"), 0.003, along=0.006)
    system.run(0.4)
    events = system.events()[known:]
    assert events
    for event in events:
        force = system.world.frames[event.time].astype(np.float32).astype(float)
        index = np.flatnonzero((force > 0) & (geometry.limb == geometry.limbs.index(event.limb)))
        field = system.field(event.field)
        assert len(index) > 1
        points, forces = geometry.points[index], force[index]
        expected = gain(points, forces, field.centre, field.radius, 0.0, 0.5)
        assert event.gain == pytest.approx(expected, abs=1e-5)
        assert event.motion == pytest.approx(expected * field.motion, abs=1e-5)
    system.remove_fingers()
    system.reflex.setForces(0.005, 0.02)
    system.run_until("Watching")


def test_shipped_reflex_stops_arm_when_skin_ends_and_recovers(system: ShippedSystem) -> None:
    """Frames come twice a second, for a reflex that is blind after 0.2 s."""
    system.reflex.setForces(0.005, 0.02)
    system.press(system.field("lower_arm_outer"), 0.004)
    system.run_until("Withdrawing", 1.0)
    system.world.params.set({"skin.rate": 2.0})
    system.run_until("Frozen", 2.0)
    assert system.runners[1].state is LifecycleState.EMERGENCY
    system.remove_fingers()
    system.run(0.5)
    here = system.arm.getState().position
    system.run(0.5)
    assert system.arm.getState().position == pytest.approx(here, abs=0.01)
    system.world.params.set({"skin.rate": 50.0})
    system.run_until("Watching")
    assert system.runners[1].state is LifecycleState.COMPUTE
    assert_within_limits(system)


def assert_within_limits(system: ShippedSystem) -> None:
    """What the joints in the physics really did, from the first moment on."""
    angles, speeds = system.joints()
    assert angles.min() >= 0.0
    assert angles.max() <= 1.0
    assert speeds.max() <= 1.0, speeds.max(axis=0)

"""Switches, forces, fields and parameters of the reflex, and its events."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.runtime.parameters import ParameterRejected
from tests.touch.kinematic_robot import interfaces


def test_reflex_only_watches_while_disabled(centred_harness) -> None:
    centred_harness.reflex.enable(False)
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.5)
    assert centred_harness.robot.moves == []
    centred_harness.reflex.enable(True)
    centred_harness.run(0.02)
    assert len(centred_harness.robot.moves) == 1


def test_reflex_completes_withdrawal_when_disabled(centred_harness) -> None:
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.04)
    centred_harness.reflex.enable(False)
    centred_harness.run_until("Watching")
    assert centred_harness.robot.pose == pytest.approx(centred_harness.robot.rest, abs=0.03)


def test_reflex_applies_changed_forces_and_fields(centred_harness) -> None:
    centred_harness.reflex.setForces(6.0, 12.0)
    assert (centred_harness.worker().params.threshold, centred_harness.worker().params.full) == (
        6.0,
        12.0,
    )
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.5)
    assert centred_harness.robot.moves == []
    centred_harness.reflex.setForces(0.5, 1.0)
    field = centred_harness.field("lower_arm_under")
    motion = np.array([0.0, 0.0, 0.2, 0.0, 0.0])
    limb = f"{centred_harness.robot.side}/{field.limb}"
    mine = interfaces.Field("mine", limb, *field.centre.tolist(), 0.04, motion)
    centred_harness.reflex.setFields([mine])
    assert [(f.name, f.limb, f.radius) for f in centred_harness.reflex.getFields()] == [
        ("mine", limb, 0.04)
    ]
    start = centred_harness.robot.pose
    centred_harness.run(0.02)
    moved = centred_harness.robot.moves[0][1] - start
    assert 0.1 < moved[2] <= 0.2
    assert np.delete(moved, 2) == pytest.approx(0.0)


def test_reflex_applies_changed_machine_parameters(centred_harness) -> None:
    params = centred_harness.worker().params
    with pytest.raises(
        ParameterRejected, match=r"`threshold`, 0.6 N, must be less than `full`, 0.5 N"
    ):
        params.set({"threshold": 0.6})
    params.set({"threshold": 0.6, "full": 3.0, "hold": 0.2, "withdraw_speed": 0.5})
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.04)
    centred_harness.release()
    start, (_, goal, speeds) = centred_harness.robot.rest, centred_harness.robot.moves[0]
    moved = np.abs(goal - start) > 1e-9
    shares = (speeds / centred_harness.robot.arm.speed_limits)[moved]
    assert shares.max() == pytest.approx(0.5)
    durations = (np.abs(goal - start)[moved] / speeds[moved]).tolist()
    assert durations == pytest.approx([durations[0]] * len(durations))
    centred_harness.run_until("Holding")
    centred_harness.run(0.26)
    assert centred_harness.state == "Returning"


def test_reflex_joins_taxels_within_reach_to_one_touch(centred_harness) -> None:
    """Two neighbours: one weak touch of their mean, or a weak and a strong one."""
    skin, field = centred_harness.robot.geometry, centred_harness.field("lower_arm_under")
    near = np.flatnonzero(centred_harness.taxels_near(field, 0.03))
    first = near[np.argmin(np.linalg.norm(skin.points[near] - field.centre, axis=1))]
    apart = np.linalg.norm(skin.points[near] - skin.points[first], axis=1)
    centred_harness.robot.forces[first] = 0.5
    centred_harness.robot.forces[near[np.argsort(apart)[1]]] = 0.06
    centred_harness.run(0.02)
    (response,) = [
        e
        for e in centred_harness.robot.reflex_messages
        if isinstance(e, interfaces.Event) and e.field == "lower_arm_under"
    ]
    assert 0.2 < response.force < 0.35
    centred_harness.worker().params.set({"reach": 0.002})
    centred_harness.run(0.02)
    events = [e for e in centred_harness.robot.reflex_messages if isinstance(e, interfaces.Event)]
    assert max(e.force for e in events) == pytest.approx(0.5)


def test_reflex_events_report_response_and_state(centred_harness) -> None:
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.02)
    centred_harness.release()
    centred_harness.run_until("Watching")
    messages = centred_harness.robot.reflex_messages
    states = [message for message in messages if isinstance(message, interfaces.ReflexState)]
    assert [state.name for state in states] == [
        "Watching",
        "Withdrawing",
        "Holding",
        "Returning",
        "Watching",
    ]
    event = next(message for message in messages if isinstance(message, interfaces.Event))
    field = centred_harness.field("lower_arm_under")
    assert (event.field, event.limb) == (field.name, f"{centred_harness.robot.side}/{field.limb}")
    assert event.force == pytest.approx(5.0)
    assert event.gain == pytest.approx(1 - event.distance / field.radius)
    assert event.motion == pytest.approx(event.gain * field.motion)
    assert np.array([event.x, event.y, event.z]) == pytest.approx(field.centre, abs=0.01)
    assert event.time == pytest.approx(0.71, abs=0.011)

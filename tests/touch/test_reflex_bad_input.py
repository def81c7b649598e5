"""What the reflex does with input that cannot be right, and with none at all.

Bad frames are rejected and counted; a silent skin or arm freezes the reflex, as an emergency that
says why, and it recovers by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy, LifeState
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from tests.touch.kinematic_robot import ROBOTS, KinematicRobot, ReflexHarness, interfaces

COUNTERS = ("framesNotFinite", "framesWrongLength", "framesOutOfOrder", "framesOtherGeometry")


@pytest.fixture
def start_reflex() -> Iterator[Callable[..., ReflexHarness]]:
    systems: list[ReflexHarness] = []

    def make(*arguments: object, **params: object) -> ReflexHarness:
        systems.append(ReflexHarness(*arguments, **params))
        return systems[-1]

    yield make
    for system in systems:
        system.close()


@pytest.fixture(params=ROBOTS)
def touched(start_reflex, request) -> ReflexHarness:
    return start_reflex(request.param).awake()


def changed(frame: Any, **fields: object) -> Any:
    for name, value in fields.items():
        setattr(frame, name, value)
    return frame


def with_value(frame: Any, value: float) -> Any:
    force = frame.force.copy()
    force[3] = value
    return changed(frame, force=force)


BAD: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "NaN": ("framesNotFinite", lambda f: with_value(f, np.nan)),
    "infinity": ("framesNotFinite", lambda f: with_value(f, np.inf)),
    "minus infinity": ("framesNotFinite", lambda f: with_value(f, -np.inf)),
    "no time": ("framesNotFinite", lambda f: changed(f, time=np.nan)),
    "one taxel short": ("framesWrongLength", lambda f: changed(f, force=f.force[1:])),
    "one taxel more": ("framesWrongLength", lambda f: changed(f, force=np.append(f.force, 1))),
    "empty": ("framesWrongLength", lambda f: changed(f, force=f.force[:0])),
    "again": ("framesOutOfOrder", lambda f: changed(f, sequence=35, time=0.68)),
    "late": ("framesOutOfOrder", lambda f: changed(f, sequence=9, time=0.18)),
    "older geometry": ("framesOtherGeometry", lambda f: changed(f, geometry=0)),
    "newer geometry": ("framesOtherGeometry", lambda f: changed(f, geometry=2)),
}  # fmt: skip


@pytest.mark.parametrize(("counter", "spoil"), BAD.values(), ids=list(BAD))
def test_reflex_rejects_and_counts_bad_frame(touched, counter, spoil) -> None:
    touched.press("lower_arm_under", 20.0)  # it would withdraw if it believed it
    touched.robot.spoil = spoil
    touched.run(0.1)
    assert touched.robot.moves == []
    seen = touched.reflex.getStatistics()
    assert {name: getattr(seen, name) for name in COUNTERS} == {
        n: 5 * (n == counter) for n in COUNTERS
    }
    assert touched.state == "Watching"  # 0.1 s without a good frame is not blind yet
    touched.robot.spoil = lambda frame: frame
    touched.run(0.02)
    assert len(touched.robot.moves) == 1
    assert touched.reflex.getStatistics().framesAccepted == seen.framesAccepted + 1


@pytest.mark.parametrize(("counter", "spoil"), BAD.values(), ids=list(BAD))
def test_reflex_freezes_on_bad_frames_only(start_reflex, counter, spoil) -> None:
    touched = start_reflex().awake()
    touched.robot.spoil = spoil
    touched.run(0.3)
    assert touched.state == "Frozen"
    assert touched.runners[0].state is LifecycleState.EMERGENCY
    assert "no valid frame of the skin received for 0.2 s" in touched.worker().reason
    touched.press("lower_arm_under", 20.0)
    touched.run(2.0)
    assert touched.state == "Frozen"
    assert touched.robot.moves == []
    touched.robot.spoil = lambda frame: frame
    touched.release()
    touched.run(0.6)
    assert touched.state == "Watching"
    assert touched.runners[0].state is LifecycleState.COMPUTE


def test_reflex_ignores_frames_before_geometry_is_known(start_reflex) -> None:
    touched = start_reflex()
    touched.run(0.7)
    seen = touched.reflex.getStatistics()
    assert [getattr(seen, name) for name in COUNTERS] == [0, 0, 0, 0]


def test_reflex_accepts_restarted_frame_numbers_after_timeout(touched) -> None:
    touched.robot.spoil = lambda f: changed(f, sequence=f.sequence - 1000, time=f.time - 100)
    touched.run(0.3)
    assert touched.state == "Frozen"
    touched.until("Watching", 1.0)
    touched.press("lower_arm_under", 20.0)
    touched.run(0.02)
    assert touched.state == "Withdrawing"


def test_reflex_requests_newer_geometry(touched) -> None:
    asked = touched.robot.asked
    geometry = touched.robot.geometry
    keep = np.arange(geometry.size) >= 10  # ten taxels are gone
    touched.robot.geometry = replace(
        geometry, version=2, ids=geometry.ids[keep], patch=geometry.patch[keep],
        limb=geometry.limb[keep], points=geometry.points[keep], normals=geometry.normals[keep],
    )  # fmt: skip
    touched.press("upper_arm_front", 5.0)
    touched.run(0.1)
    assert touched.robot.asked == asked + 1
    assert touched.state in ("Withdrawing", "Holding")
    assert set(touched.worker().withdrawal.strongest) == {"upper_arm_front"}
    assert touched.reflex.getStatistics().framesOtherGeometry <= 2


def test_reflex_detects_restarted_skin_with_older_version(touched) -> None:
    touched.robot.geometry = replace(touched.robot.geometry, version=5)
    touched.run(0.2)
    touched.robot.geometry = replace(touched.robot.geometry, version=1)
    touched.run(0.3)
    assert touched.state == "Frozen"
    touched.run(1.5)
    assert touched.state == "Watching"


class Confused(KinematicRobot):
    """Its skin contradicts itself as long as `confused`."""

    confused = True

    def get_geometry(self) -> Any:
        geometry = super().get_geometry()
        if self.confused:
            geometry.limb = geometry.limb + 100
        return geometry


def test_reflex_is_in_emergency_while_geometry_is_invalid(start_reflex) -> None:
    touched = start_reflex("nao_h25", "left_arm", Confused)
    touched.run(1.0)
    assert touched.state == "Frozen"
    assert "`limb` refers to entry" in touched.worker().reason
    touched.robot.confused = False
    touched.run(1.0)
    assert touched.state == "Watching"


def test_reflex_reports_skin_without_limbs_of_fields(start_reflex) -> None:
    class Bare(KinematicRobot):
        def get_geometry(self) -> Any:
            geometry = super().get_geometry()
            for limb in geometry.limbs:
                limb.name = limb.name.replace("lower_arm", "tail")
            return geometry

    touched = start_reflex("nao_h25", "left_arm", Bare)
    touched.run(1.0)
    assert touched.state == "Frozen"
    assert "no limb `left_arm/lower_arm` for the field" in touched.worker().reason
    assert "left_arm/tail" in touched.worker().reason


WRONG_LIMITS = {
    "4 joints": {name: np.zeros(4) for name in ("low", "high", "speed", "start")},
    "NaN": {"start": np.full(5, np.nan)},
    "differ in length": {"speed": np.ones(4)},
    "above its upper": {"low": np.full(5, 9.0)},
    "speed limit of 0": {"speed": np.zeros(5)},
}


@pytest.mark.parametrize(("message", "wrong"), WRONG_LIMITS.items(), ids=list(WRONG_LIMITS))
def test_reflex_stays_frozen_with_invalid_arm_limits(start_reflex, message, wrong) -> None:
    class Odd(KinematicRobot):
        def limits(self) -> Any:
            return changed(super().limits(), **wrong)

    touched = start_reflex("nao_h25", "left_arm", Odd)
    touched.run(1.0)
    assert touched.state == "Frozen"
    assert message in touched.worker().reason


@pytest.mark.parametrize("pose", [np.full(5, np.nan), np.zeros(4), np.zeros(0)])
def test_reflex_ignores_invalid_arm_state(touched, pose) -> None:
    publish = touched.robot.states_proxy.armState
    touched.robot.states_proxy.armState = lambda state: publish(changed(state, position=pose))
    touched.run(0.4)
    assert touched.state == "Watching"
    touched.run(0.2)
    assert touched.state == "Frozen"
    assert "no state of the arm received" in touched.worker().reason


@pytest.mark.parametrize("lost", ["feels", "tells"])
def test_reflex_freezes_and_keeps_watching_while_peers_are_silent(touched, lost) -> None:
    setattr(touched.robot, lost, False)
    touched.run(0.6)
    assert touched.state == "Frozen"
    assert touched.robot.stops == 1
    setattr(touched.robot, lost, True)
    touched.run(0.4)
    assert touched.state == "Frozen"  # it must have been there for a while
    touched.run(0.3)
    assert touched.state == "Watching"
    assert touched.robot.moves == []  # the arm was where it belongs


@pytest.mark.parametrize(("lost", "state"), [(10, "Watching"), (11, "Watching"), (12, "Frozen")])
def test_reflex_freezes_only_after_second_look(touched, lost, state) -> None:
    """Eleven frames are more than 0.2 s; but one that was held up itself has them waiting."""
    touched.robot.feels = False
    touched.run(0.02 * lost)
    touched.robot.feels = True
    touched.run(0.02)
    assert touched.state == state


@pytest.mark.parametrize("lost", ["feels", "tells"])
def test_reflex_stops_moving_arm_and_returns_later(touched, lost) -> None:
    touched.press("lower_arm_outer", 20.0)
    touched.run(0.06)
    touched.release()
    assert touched.state == "Withdrawing"
    setattr(touched.robot, lost, False)
    touched.until("Frozen", 0.6)
    there, moves = touched.robot.pose, len(touched.robot.moves)
    assert touched.robot.stops == 1
    touched.press("lower_arm_outer", 20.0)
    touched.run(1.0)
    assert len(touched.robot.moves) == moves
    assert (touched.robot.pose == there).all()
    touched.release()
    setattr(touched.robot, lost, True)
    touched.until("Returning", 1.0)
    touched.until("Watching")
    assert touched.robot.pose == pytest.approx(touched.robot.part.start, abs=0.03)


def test_reflex_freezes_when_arm_refuses_and_stops_it_later(touched) -> None:
    touched.robot.answers = False
    touched.press("lower_arm_under", 20.0)
    touched.run(0.1)
    assert touched.state == "Frozen"
    assert "the arm does not move" in touched.worker().reason or "cable" in touched.worker().reason
    assert touched.robot.stops == 0
    touched.release()
    touched.run(2.0)
    assert touched.state == "Frozen"
    assert "the cable is out" in touched.worker().reason
    touched.robot.answers = True
    touched.run(0.2)
    assert touched.robot.stops == 1
    assert touched.state == "Frozen"
    touched.until("Watching")
    assert touched.robot.stops == 1


def test_reflex_freezes_again_when_arm_cannot_return(touched) -> None:
    touched.press("lower_arm_under", 20.0)
    touched.run(0.04)
    touched.release()
    touched.until("Holding")
    touched.robot.answers = False
    touched.run(1.0)
    assert touched.state == "Frozen"
    touched.robot.answers = True
    touched.until("Watching")


def test_reflex_emergency_is_visible_with_reason(touched) -> None:
    about = touched.proxy(ComponentProxy, "reflex", "Component")
    assert COMPONENT is ComponentProxy.INTERFACE
    assert about.getInfo().state == LifeState.Compute
    touched.robot.tells = False
    touched.run(0.7)
    info = about.getInfo()
    assert info.state == LifeState.Emergency
    assert info.reason == "no state of the arm received for 0.5 s"
    assert info.states == ["Frozen"]
    assert touched.reflex.getStatistics().state == interfaces.ReflexState.Frozen
    assert touched.robot.heard[-1] == interfaces.ReflexState.Frozen
    touched.robot.tells, touched.robot.feels = True, False
    touched.run(0.3)
    assert about.getInfo().reason == "no valid frame of the skin received for 0.2 s"
    touched.robot.feels = True
    touched.until("Watching")
    assert about.getInfo().reason == ""


def test_reflex_treats_restarted_time_as_interruption(touched) -> None:
    touched.press("lower_arm_under", 20.0)
    touched.run(0.04)
    touched.release()
    touched.run(1.0)
    touched.robot.clock.reset()
    touched.until("Frozen", 1.0)
    touched.until("Watching", 5.0)
    touched.press("lower_arm_under", 20.0)
    touched.run(0.04)
    assert touched.state == "Withdrawing"
    assert touched.reflex.getStatistics().withdrawals == 2


FIELD = {"name": "f", "limb": "left_arm/lower_arm", "x": 0.05, "y": 0.0, "z": 0.03,
         "radius": 0.03, "motion": np.full(5, 0.1)}  # fmt: skip
WRONG_FIELDS = {
    "no limb `left_arm/tail`": {"limb": "left_arm/tail"},
    "write the limb as `left_arm/LIMB`": {"limb": "lower_arm"},
    "is on `right_arm/lower_arm`": {"limb": "right_arm/lower_arm"},
    "NaN or infinity": {"x": np.nan},
    "holds NaN": {"motion": np.full(5, np.inf)},
    "must be positive": {"radius": 0.0},
    "has 3 angles, the arm 5": {"motion": np.zeros(3)},
}


@pytest.mark.parametrize(("message", "wrong"), WRONG_FIELDS.items(), ids=list(WRONG_FIELDS))
def test_reflex_rejects_invalid_fields_unchanged(start_reflex, message, wrong) -> None:
    touched = start_reflex("icub_v2").awake()
    before = [field.name for field in touched.reflex.getFields()]
    with pytest.raises(interfaces.RoboCompReflex_NotPossible) as caught:
        touched.reflex.setFields(
            [interfaces.Field(**FIELD), interfaces.Field(**{**FIELD, "name": "g", **wrong})]
        )
    assert message in caught.value.what
    assert [field.name for field in touched.reflex.getFields()] == before


def test_reflex_refuses_duplicate_field_names(touched) -> None:
    with pytest.raises(interfaces.RoboCompReflex_NotPossible, match="two fields of the name `f`"):
        touched.reflex.setFields([interfaces.Field(**FIELD), interfaces.Field(**FIELD)])


@pytest.mark.parametrize(
    ("threshold", "full"), [(1.0, 1.0), (2.0, 1.0), (-1.0, 1.0), (np.nan, 1.0), (0.1, np.inf)]
)
def test_reflex_refuses_invalid_forces_unchanged(touched, threshold, full) -> None:
    law = touched.worker().sense.law
    with pytest.raises(interfaces.RoboCompReflex_NotPossible):
        touched.reflex.setForces(threshold, full)
    assert touched.worker().sense.law is law

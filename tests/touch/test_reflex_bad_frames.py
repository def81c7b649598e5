"""Frames and geometries of the skin that the reflex rejects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from tests.touch.kinematic_robot import KinematicRobot, with_fields

COUNTERS = ("framesNotFinite", "framesWrongLength", "framesOutOfOrder", "framesOtherGeometry")


def with_value(frame: Any, value: float) -> Any:
    force = frame.force.copy()
    force[3] = value
    return with_fields(frame, force=force)


BAD: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "NaN": ("framesNotFinite", lambda f: with_value(f, np.nan)),
    "infinity": ("framesNotFinite", lambda f: with_value(f, np.inf)),
    "minus infinity": ("framesNotFinite", lambda f: with_value(f, -np.inf)),
    "no time": ("framesNotFinite", lambda f: with_fields(f, time=np.nan)),
    "one taxel short": ("framesWrongLength", lambda f: with_fields(f, force=f.force[1:])),
    "one taxel more": ("framesWrongLength", lambda f: with_fields(f, force=np.append(f.force, 1))),
    "empty": ("framesWrongLength", lambda f: with_fields(f, force=f.force[:0])),
    "again": ("framesOutOfOrder", lambda f: with_fields(f, sequence=35, time=0.68)),
    "late": ("framesOutOfOrder", lambda f: with_fields(f, sequence=9, time=0.18)),
    "older geometry": ("framesOtherGeometry", lambda f: with_fields(f, geometry=0)),
    "newer geometry": ("framesOtherGeometry", lambda f: with_fields(f, geometry=2)),
}  # fmt: skip


@pytest.mark.parametrize(("counter", "alter_frame"), BAD.values(), ids=list(BAD))
def test_reflex_rejects_and_counts_bad_frame(harness, counter, alter_frame) -> None:
    harness.press("lower_arm_under", 20.0)  # it would withdraw if it believed it
    harness.robot.alter_frame = alter_frame
    harness.run(0.1)
    assert harness.robot.moves == []
    seen = harness.reflex.getStatistics()
    assert {name: getattr(seen, name) for name in COUNTERS} == {
        n: 5 * (n == counter) for n in COUNTERS
    }
    assert harness.state == "Watching"  # 0.1 s without a good frame is not blind yet
    harness.robot.alter_frame = lambda frame: frame
    harness.run(0.02)
    assert len(harness.robot.moves) == 1
    assert harness.reflex.getStatistics().framesAccepted == seen.framesAccepted + 1


@pytest.mark.parametrize(("counter", "alter_frame"), BAD.values(), ids=list(BAD))
def test_reflex_freezes_on_bad_frames_only(start_reflex, counter, alter_frame) -> None:
    harness = start_reflex().wait_until_watching()
    harness.robot.alter_frame = alter_frame
    harness.run(0.3)
    assert harness.state == "Frozen"
    assert harness.runners[0].state is LifecycleState.EMERGENCY
    assert "no valid frame of the skin received for 0.2 s" in harness.worker().reason
    harness.press("lower_arm_under", 20.0)
    harness.run(2.0)
    assert harness.state == "Frozen"
    assert harness.robot.moves == []
    harness.robot.alter_frame = lambda frame: frame
    harness.release()
    harness.run(0.6)
    assert harness.state == "Watching"
    assert harness.runners[0].state is LifecycleState.COMPUTE


def test_reflex_ignores_frames_before_geometry_is_known(start_reflex) -> None:
    harness = start_reflex()
    harness.run(0.7)
    seen = harness.reflex.getStatistics()
    assert [getattr(seen, name) for name in COUNTERS] == [0, 0, 0, 0]


def test_reflex_accepts_restarted_frame_numbers_after_timeout(harness) -> None:
    harness.robot.alter_frame = lambda f: with_fields(
        f, sequence=f.sequence - 1000, time=f.time - 100
    )
    harness.run(0.3)
    assert harness.state == "Frozen"
    harness.run_until("Watching", 1.0)
    harness.press("lower_arm_under", 20.0)
    harness.run(0.02)
    assert harness.state == "Withdrawing"


def test_reflex_requests_newer_geometry(harness) -> None:
    asked = harness.robot.geometry_requests
    geometry = harness.robot.geometry
    keep = np.arange(geometry.size) >= 10  # ten taxels are gone
    harness.robot.geometry = replace(
        geometry, version=2, ids=geometry.ids[keep], patch=geometry.patch[keep],
        limb=geometry.limb[keep], points=geometry.points[keep], normals=geometry.normals[keep],
    )  # fmt: skip
    harness.press("upper_arm_front", 5.0)
    harness.run(0.1)
    assert harness.robot.geometry_requests == asked + 1
    assert harness.state in ("Withdrawing", "Holding")
    assert set(harness.worker().withdrawal.strongest) == {"upper_arm_front"}
    assert harness.reflex.getStatistics().framesOtherGeometry <= 2


def test_reflex_detects_restarted_skin_with_older_version(harness) -> None:
    harness.robot.geometry = replace(harness.robot.geometry, version=5)
    harness.run(0.2)
    harness.robot.geometry = replace(harness.robot.geometry, version=1)
    harness.run(0.3)
    assert harness.state == "Frozen"
    harness.run(1.5)
    assert harness.state == "Watching"


class ContradictoryGeometryRobot(KinematicRobot):
    """Its skin contradicts itself as long as `contradictory`."""

    contradictory = True

    def get_geometry(self) -> Any:
        geometry = super().get_geometry()
        if self.contradictory:
            geometry.limb = geometry.limb + 100
        return geometry


def test_reflex_is_in_emergency_while_geometry_is_invalid(start_reflex) -> None:
    harness = start_reflex("nao_h25", "left_arm", ContradictoryGeometryRobot)
    harness.run(1.0)
    assert harness.state == "Frozen"
    assert "`limb` refers to entry" in harness.worker().reason
    harness.robot.contradictory = False
    harness.run(1.0)
    assert harness.state == "Watching"


def test_reflex_reports_skin_without_limbs_of_fields(start_reflex) -> None:
    class RobotWithoutLowerArm(KinematicRobot):
        def get_geometry(self) -> Any:
            geometry = super().get_geometry()
            for limb in geometry.limbs:
                limb.name = limb.name.replace("lower_arm", "tail")
            return geometry

    harness = start_reflex("nao_h25", "left_arm", RobotWithoutLowerArm)
    harness.run(1.0)
    assert harness.state == "Frozen"
    assert "no limb `left_arm/lower_arm` for the field" in harness.worker().reason
    assert "left_arm/tail" in harness.worker().reason

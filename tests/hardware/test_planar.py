import math

import pytest

from robocomp_dsl.hardware.kinematics.planar import Pose, arc, wrap_angle

QUARTER = math.pi / 2


def approximately(pose: Pose) -> object:
    return pytest.approx((pose.x, pose.z, pose.alpha), abs=1e-9)


def numbers(pose: Pose) -> tuple[float, float, float]:
    return pose.x, pose.z, pose.alpha


@pytest.mark.parametrize(
    ("start", "step", "end"),
    [
        (Pose(), Pose(10, 20, 0.3), Pose(10, 20, 0.3)),
        # heading to x (a quarter turn to the right): ahead is x, the right-hand side is -z
        (Pose(0, 0, QUARTER), Pose(0, 100, 0), Pose(100, 0, QUARTER)),
        (Pose(0, 0, QUARTER), Pose(100, 0, 0), Pose(0, -100, QUARTER)),
        (Pose(5, 7, math.pi - 0.1), Pose(0, 0, 0.2), Pose(5, 7, 0.1 - math.pi)),
    ],
)
def test_planar_step_is_in_frame_of_pose(start: Pose, step: Pose, end: Pose) -> None:
    assert numbers(start.then(step)) == approximately(end)


def test_planar_inverse_cancels_pose() -> None:
    pose = Pose(120, -45, 2.2)
    assert numbers(pose.then(pose.inverse())) == approximately(Pose())
    assert numbers(pose.inverse().then(pose)) == approximately(Pose())


@pytest.mark.parametrize(
    ("left", "right", "step"),
    [
        (50, 50, Pose(0, 50, 0)),
        (50, -50, Pose(0, 0, 0.5)),  # left wheel ahead: turns right, positive
        # a quarter circle to the right around a point 300 mm to the right
        (400 * QUARTER, 200 * QUARTER, Pose(300, 300, QUARTER)),
        (200 * QUARTER, 400 * QUARTER, Pose(-300, 300, -QUARTER)),
    ],
)
def test_planar_arc_follows_from_wheel_distances(left: float, right: float, step: Pose) -> None:
    assert numbers(arc(left, right, 200)) == approximately(step)


def test_planar_angles_are_wrapped_to_one_turn() -> None:
    assert wrap_angle(3 * math.pi) == -math.pi
    assert wrap_angle(-0.1) == pytest.approx(-0.1)

"""The poses of hands and points of the robots, as published."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.simulation.robots.catalog import description
from tests.simulation.models.simulated_robot import PI, TENTH_MM, SimulatedRobot

ARM = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw")

CHAIN = (
    "shoulder_pitch",
    "shoulder_roll",
    "shoulder_yaw",
    "elbow",
    "wrist_prosup",
    "wrist_pitch",
    "wrist_yaw",
)


def nao_angles(side: str, values) -> dict[str, float]:
    return {side + joint: value for joint, value in zip(ARM, values, strict=False)}


NAO_HANDS = [
    ("L", (0, 0, 0, 0, 0), (0.21870, 0.11300, 0.08769)),
    ("R", (0, 0, 0, 0, 0), (0.21870, -0.11300, 0.08769)),
    ("L", (PI / 2, 0, 0, 0, 0), (-0.01231, 0.11300, -0.11870)),
    ("L", (-PI / 2, 0, 0, 0, 0), (0.01231, 0.11300, 0.31870)),
    ("L", (0, 0, 0, -PI / 2, 0), (0.10500, -0.00070, 0.08769)),
    ("R", (0, 0, 0, PI / 2, 0), (0.10500, 0.00070, 0.08769)),
    ("L", (1.0, 0.2, -0.5, -1.0, 0.3), (0.12670, 0.06025, -0.03327)),
    ("R", (1.0, -0.2, 0.5, 1.0, -0.3), (0.12670, -0.06025, -0.03327)),
]


@pytest.mark.parametrize(("side", "angles", "hand"), NAO_HANDS)
def test_nao_hands_match_published_kinematics(side, angles, hand):
    nao = SimulatedRobot("nao_h25")
    nao.pose(**nao_angles(side, angles))
    assert nao.site(f"{side.lower()}_hand") == pytest.approx(hand, abs=TENTH_MM)
    part = description("nao_h25").part("left_arm" if side == "L" else "right_arm")
    assert part.chain.pose(np.array(angles))[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_nao_points_match_published_kinematics():
    small = SimulatedRobot("nao_h21")
    small.pose(**nao_angles("L", (0, 0, 0, 0)))
    assert small.site("l_hand") == pytest.approx((0.2187, 0.113, 0.1), abs=TENTH_MM)
    chain = description("nao_h21").part("left_arm").chain
    assert chain.pose(np.zeros(5))[:3, 3] == pytest.approx((0.2187, 0.113, 0.1), abs=TENTH_MM)
    assert small.site("CameraTop") == pytest.approx((0.05871, 0, 0.19014), abs=TENTH_MM)
    assert small.site("CameraBottom") == pytest.approx((0.05071, 0, 0.14424), abs=TENTH_MM)
    assert small.site("l_sole") == pytest.approx((0, 0.05, -0.33301), abs=TENTH_MM)


ICUB_HANDS = [
    ("r", (0, 0, 0), (0, 0, 0, 0, 0, 0, 0), (-0.010817, 0.084136, -0.180780)),
    ("l", (0, 0, 0), (0, 0, 0, 0, 0, 0, 0), (-0.010817, -0.084136, -0.180780)),
    ("r", (0, 0, 0), (-30, 30, 0, 45, 0, 0, 0), (-0.304333, 0.202342, 0.025913)),
    ("l", (0, 0, 0), (-30, 30, 0, 45, 0, 0, 0), (-0.304333, -0.202342, 0.025913)),
    ("r", (10, 5, -15), (-40, 50, 20, 60, 30, -20, 10), (-0.389795, 0.141490, 0.093442)),
    ("l", (10, 5, -15), (-40, 50, 20, 60, 30, -20, 10), (-0.260092, -0.321604, 0.075171)),
]


def icub_angles(side, torso, arm) -> dict[str, float]:
    named = dict(zip(("torso_pitch", "torso_roll", "torso_yaw"), np.deg2rad(torso), strict=True))
    joints = (f"{side}_{joint}" for joint in CHAIN)
    return named | dict(zip(joints, np.deg2rad(arm), strict=True))


@pytest.mark.parametrize(("side", "torso", "arm", "hand"), ICUB_HANDS)
def test_icub_hands_match_published_kinematics(side, torso, arm, hand):
    icub = SimulatedRobot("icub_v2")
    icub.pose(**icub_angles(side, torso, arm))
    assert icub.site(f"{side}_hand") == pytest.approx(hand, abs=TENTH_MM)
    if not any(torso) and not any(arm[5:]):
        part = description("icub_v2").part("left_arm" if side == "l" else "right_arm")
        angles = np.deg2rad(arm[:5])
        assert part.chain.pose(angles)[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_icub_points_match_published_kinematics():
    icub = SimulatedRobot("icub_v2")
    icub.pose(**dict.fromkeys(icub.robot.joints, 0.0))
    assert icub.site("r_eye") == pytest.approx((-0.0564, 0.034, 0.34685), abs=TENTH_MM)
    assert icub.site("l_eye") == pytest.approx((-0.0564, -0.034, 0.34685), abs=TENTH_MM)
    frames = {  # right arm at zero, origins of the table's links
        "r_shoulder_1": (0.01707, 0.00605, 0.1753),
        "r_shoulder_2": (-0.01082, 0.11012, 0.1753),
        "r_elbow": (-0.02582, 0.11012, 0.02302),
        "r_forearm": (-0.01082, 0.11012, 0.02302),
        "r_wrist": (-0.01082, 0.11012, -0.11828),
    }
    for body, origin in frames.items():
        assert icub.in_root(icub.data.body(body).xpos) == pytest.approx(origin, abs=TENTH_MM)
    turn = icub.data.site("r_hand").xmat.reshape(3, 3)
    root = icub.data.body("root_link").xmat.reshape(3, 3)
    assert root.T @ turn == pytest.approx(np.array([[0, 1, 0], [0, 0, -1], [-1, 0, 0]]), abs=1e-9)

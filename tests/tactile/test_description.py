"""Descriptions of a robot's skin, limbs and fields, in YAML."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.description.check import RobotStructure, compare
from robocomp_dsl.tactile.description.read import read_robot, rotation_from_rpy
from robocomp_dsl.tactile.errors import DescriptionError, Fault
from robocomp_dsl.tactile.skin.cone import cartesian

GOOD = """\
robot: two_link
parts:
  left_arm:
    servos:
      - {joint: Pitch, part: LArm, gamma: -1, sigma: 90 deg, limits: [-120 deg, 2.0],
         speed: 4.0, stiffness: 0.8, damping: 0.1, start: 1.2}
      - {joint: roll, gamma: 0.017453292519943295, sigma: 0,
         limits: [0, 160], speed: 100, unit: deg}
      - {sigma: 0.1}
    held:
      - {joint: wrist, part: LArm, unit: deg, at: 30}
    chain:
      base: {position: [0, 98 mm, 0.1], rpy: [-90 deg, 0, 0]}
      rows:
        - {servo: 0, alpha: 90 deg}
        - {servo: 1, a: 15 mm, d: 0.1, alpha: 0, offset: 1}
        - {fixed: 0.5, a: 0.1}
    limbs:
      lower: {body: LForeArm, position: [0, 0, 10 mm], rpy: [0, 0, 90 deg],
              cone: {x: [0.02, 0.10], r: [32 mm, 26 mm]}}
    skin:
      - {patch: rings, limb: lower, first_id: 100, rings: {x: [0.03, 0.06, 0.09], count: 8},
         sensitivity: {gain: 0.05, floor: 2, saturation: 240}}
      - {patch: dots, limb: lower, points: [[0.05, 0], [0.06, 1]]}
    fields:
      - {name: back, limb: lower, x: 0.05, theta: 0, radius: 30 mm, motion: [-0.2, 0.3, 0]}
"""


def test_description_reads_si_units():
    arm = read_robot(GOOD, Path("r.yaml")).part("left_arm")
    assert arm.joints == ("LArm/Pitch", "roll")
    assert arm.mapping.available.tolist() == [True, True, False]
    assert arm.mapping.sigma == pytest.approx([np.pi / 2, 0, 0.1])
    assert arm.mapping.low[0] == pytest.approx(np.deg2rad(-120))
    assert arm.start == pytest.approx([np.pi / 2 - 1.2, 0, 0.1])
    assert arm.speed_limits == pytest.approx([4.0, np.deg2rad(100), 0])
    assert arm.chain.base[:3, 3] == pytest.approx([0, 0.098, 0.1])
    assert arm.chain.base[:3, 2] == pytest.approx([0, 1, 0])
    assert [row.joint for row in arm.chain.rows] == [0, 1, None]
    assert arm.chain.rows[2].offset == 0.5
    assert [(servo.joint, servo.part) for servo in arm.fixed_joints] == [("wrist", "LArm")]
    assert arm.fixed_joints[0].position == pytest.approx(np.deg2rad(30))


def test_description_places_limbs_skin_and_fields_in_limb_frame():
    arm = read_robot(GOOD, Path("r.yaml")).part("left_arm")
    limb = arm.limb("lower")
    assert limb.to_body(np.array([0.05, 0, 0])) == pytest.approx([0, 0.05, 0.01])
    assert limb.to_limb(limb.to_body(np.array([1.0, 2, 3]))) == pytest.approx([1, 2, 3])
    ring, dots = arm.patches
    assert len(ring.ids) == 240
    assert ring.ids[0] == 100
    assert ring.ids[-1] == 100 + 23 * 12 + 11
    rho = np.hypot(ring.points[:, 1], ring.points[:, 2])
    assert rho == pytest.approx(limb.cone.radius(ring.points[:, 0]))
    assert dots.ids == (0, 1)
    assert dots.points[1] == pytest.approx(cartesian(0.06, 1, 0.029))
    assert ring.sensitivity.gain == 0.05
    assert arm.fields[0].centre == pytest.approx([0.05, 0, 0.02975])


def test_description_has_generic_chain():
    arm = read_robot(GOOD, Path("r.yaml")).part("left_arm")
    generic = np.array([0.3, 0.2, 0.1])
    pitch, roll = arm.mapping.command(generic).values
    there = arm.chain.pose(np.array([pitch, np.deg2rad(roll), 0.0]))
    assert arm.generic_chain.pose(generic) == pytest.approx(there)


def faults(text: str) -> list[str]:
    with pytest.raises(DescriptionError) as caught:
        read_robot(text, Path("r.yaml"))
    return [str(finding) for finding in caught.value.findings]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("gamma: -1,", "gamma: 0,", "r.yaml:5:9: gamma must not be 0"),
        ("gamma: -1,", "gamma: .inf,", "r.yaml:5:43: a number is expected here"),
        ("gamma: -1,", "gama: -1,", "r.yaml:5:9: `gamma` is missing here"),
        ("gamma: -1,", "gama: -1,", "`gama` is not a known key here (did you mean `gamma`?)"),
        ("start: 1.2", "start: 2.5", "r.yaml:5:9: the start pose 2.5 of `Pitch` is outside"),
        ("2.0]", "-3.0]", "the lower limit -2.0944 is above the upper limit -3"),
        ("sigma: 90 deg", "sigma: 700 deg", "exceed the range of a rotating joint"),
        (
            "{sigma: 0.1}",
            "{sigma: 0.1, limits: [1, 2]}",
            "sigma 0.1 of the missing joint is outside",
        ),
        ("speed: 4.0", "speed: 0", "the speed of `Pitch` must be positive"),
        ("unit: deg", "unit: turns", "`turns` is not a unit of a joint"),
        ("joint: roll", "joint: Pitch, part: LArm", "`LArm/Pitch` is mapped twice"),
        ("joint: wrist", "joint: Pitch", "r.yaml:11:9: `LArm/Pitch` cannot be held"),
        ("wrist, part: LArm", "wrist, part: Head", "held on `Head`, where `left_arm` has no servo"),
        ("unit: deg, at: 30", "unit: deg", "r.yaml:11:9: `at` is missing here"),
        ("unit: deg, at: 30", "unit: ms, at: 30", "`ms` is not a unit of a joint"),
        ("servo: 1, a", "servo: 7, a", "r.yaml:16:19: there is no servo 7"),
        ("servo: 1, a", "servo: 0, a", "occurs at most once"),
        ("[0.02, 0.10]", "[0.10, 0.02]", "a cone must end after its start"),
        ("limb: lower, points", "limb: upper, points", "no limb `upper` (limbs: lower)"),
        ("count: 8", "count: 0", "at least one x and one module"),
        ("first_id: 100", "first_id: 1", "taxel id 1 of `dots` is also in `rings`"),
        ("[0.05, 0], [", "[0.15, 0], [", "1 taxel of `dots` is off its limb (taxel 0 is 50 mm"),
        ("x: 0.05, theta", "x: 0.5, theta", "no taxel of `lower` is in the field `back` (the near"),
        (
            "theta: 0, radius",
            "theta: 90, radius",
            "more than a full turn (if it is in degrees,",
        ),
        ("theta: 0, radius", "theta: 3 mm, radius", "an angle cannot have the unit `mm`"),
        ("[0.02, 0.10]", "[20 deg, 0.10]", "a length cannot have the unit `deg`"),
        ("gamma: -1,", "gamma: -1 m,", "a number cannot have the unit `m` (with"),
        ("[-0.2, 0.3", "[-50, 0.3", "moves `Pitch` by -50, more than its whole range (from"),
        ("[-0.2, 0.3", "[-50, 0.3", "if it is in degrees, write `-50 deg`"),
        ("sigma: 90 deg", "sigma: 90", "if it is in degrees, write `90 deg`"),
        ("stiffness: 0.8", "stiffness: -0.8", "the stiffness of `Pitch` must not be negative"),
        ("damping: 0.1", "damping: -0.1", "the damping of `Pitch` must not be negative"),
        ("count: 8", "count: 334", "at most 1000 modules, not 1002"),
        (
            "first_id: 100",
            "first_id: -1",
            "taxel ids cannot start at -1 (ids are 0 to 2147483647",
        ),
        ("first_id: 100", "first_id: 2147483400", "taxel ids cannot start at 2147483400"),
        ("patch: dots", "patch: rings", "there are two patches named `rings`"),
        (
            "    skin:",
            "      hand: {body: LForeArm, cone: {x: [0, 1], r: [1, 1]}}\n    skin:",
            "the body `LForeArm` is covered by the skin of `hand` and of `lower`",
        ),
        ("floor: 2", "floor: 300", "0 <= floor < saturation"),
        ("radius: 30 mm", "radius: 0", "radius of a field must be positive"),
        ("[-0.2, 0.3, 0]", "[-0.2, 0.3]", "3 entries are needed, there are 2"),
        ("[-0.2, 0.3, 0]", "[-0.2]", "3 entries are needed, there is 1"),
        ("points: [[0.05, 0], [0.06, 1]]", "file: none.txt", "positions `none.txt` cannot be read"),
        ("sensitivity: {", "file: x, sensitivity: {", "exactly one of rings, points, file"),
        ("robot: two_link", "", "`robot` is missing here"),
        ("position: [0, 98 mm", "position: [0, 98 miles", "a length is expected here (a unit may"),
        ("    limbs:", "    servos: []\n    limbs:", "`servos` is set twice"),
    ],
)
def test_description_reports_faults_with_position(old, new, expected):
    assert old in GOOD
    assert any(expected in reported for reported in faults(GOOD.replace(old, new, 1)))


@pytest.mark.parametrize(
    "text", ["", "- a\n- b", "a: [", "robot: x\nparts: 3", "\x01", "a: &x [*x]"]
)
def test_description_reports_texts_of_another_form(text):
    assert faults(text)


def test_description_reports_duplicate_field_names():
    again = GOOD + GOOD.splitlines()[-1] + "\n"
    assert "there are two fields named `back`" in faults(again)[0]


def test_description_accepts_units_behind_degree_numbers():
    written = GOOD.replace("limits: [0, 160], speed: 100,", "limits: [0, 2.5 rad], speed: 100 deg,")
    roll = read_robot(written, Path("r.yaml")).part("left_arm").servos[1]
    assert (roll.low, roll.high, roll.speed) == pytest.approx((0.0, np.rad2deg(2.5), 100.0))
    held = (
        read_robot(GOOD.replace("at: 30", "at: 30 deg"), Path("r.yaml"))
        .part("left_arm")
        .fixed_joints
    )
    assert held[0].position == pytest.approx(np.deg2rad(30))


def test_description_reports_all_faults_at_once():
    text = GOOD.replace("speed: 4.0", "speed: 0").replace("first_id: 100", "first_id: 1")
    assert len(faults(text)) == 2


def test_description_reports_invalid_number_once():
    assert len(faults(GOOD.replace("gamma: -1,", "gamma: much,"))) == 1


def test_description_reads_positions_from_file_beside_it(tmp_path):
    points = cartesian(np.array([0.03, 0.05]), np.array([0.0, 1.0]), 0.03)
    body = read_robot(GOOD, Path("r.yaml")).part("left_arm").limb("lower").to_body(points)
    rows = ["0 0 0 0 0 0", *(f"{x} {y} {z} 0 0 1" for x, y, z in body)]
    (tmp_path / "taxels.txt").write_text("[calibration]\n" + "\n".join(rows) + "\n")
    text = GOOD.replace("points: [[0.05, 0], [0.06, 1]]", "file: taxels.txt")
    patch = read_robot(text, tmp_path / "r.yaml").part("left_arm").patches[1]
    assert patch.ids == (1, 2)
    assert patch.points == pytest.approx(points)
    (tmp_path / "taxels.txt").write_text("[calibration]\n1 2 3\n")
    with pytest.raises(DescriptionError, match=r"taxels\.txt:2:1"):
        read_robot(text, tmp_path / "r.yaml")


def test_description_is_compared_with_joints_and_bodies_of_robot():
    robot = read_robot(GOOD, Path("r.yaml"))
    turn = np.deg2rad(160)
    fit = {"Pitch": (-2.1, 2.0), "roll": (0, turn), "wrist": (-1, 1)}
    compare(robot, RobotStructure(fit, frozenset({"LForeArm"})))
    wrong = {"Pitsch": (-2.1, 2.0), "roll": (0, np.deg2rad(90)), "wrist": (-1, 0.2)}
    with pytest.raises(DescriptionError) as caught:
        compare(robot, RobotStructure(wrong, frozenset({"LForearm", "torso"})))
    assert [str(finding) for finding in caught.value.findings] == [
        "r.yaml:5:9: the robot has no joint `Pitch` (did you mean `Pitsch`?)",
        "r.yaml:7:9: the limits of `roll` are wider than the robot's (the robot has 0 to 90 deg)",
        "r.yaml:11:9: `wrist` cannot be held at 0.523599, outside its limits "
        "(the robot has -1 to 0.2)",
        "r.yaml:19:14: the limb `lower` is on `LForeArm`, which the robot does not have "
        "(did you mean `LForearm`?)",
    ]
    assert [finding.kind for finding in caught.value.findings] == [
        Fault.JOINT,
        Fault.LIMITS,
        Fault.LIMITS,
        Fault.BODY,
    ]


def test_description_rotations_turn_about_fixed_axes():
    turned = rotation_from_rpy(np.pi / 2, -np.pi / 2, 0)
    assert turned == pytest.approx(np.array([[0, -1, 0], [0, 0, -1], [1, 0, 0]]), abs=1e-12)

"""The tactile descriptions of the robots: generic angles, limbs, fields and skin."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description, facts
from robocomp_dsl.tactile.description.check import compare
from robocomp_dsl.tactile.description.coverage import covered
from robocomp_dsl.tactile.errors import DescriptionError
from tests.simulation.models.simulated_robot import PI, TENTH_MM, SimulatedRobot

# the generic arms of the descriptions, on the simulated bodies

SIDES = [(name, f"{side}_arm") for name in ROBOTS for side in ("left", "right")]


def generic(simulated: SimulatedRobot, part, values) -> None:
    """Bring the simulated arm to generic angles."""
    mapping = part.mapping
    device = (values - mapping.sigma) / mapping.gamma * mapping.to_si
    named = {s.joint: v for s, v in zip(part.servos, device, strict=True) if s.joint}
    simulated.pose(**named)


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_generic_angles_mean_same_motion(name, side):
    robot, part = SimulatedRobot(name), description(name).part(side)
    outward = 1.0 if side == "left_arm" else -1.0
    hand = f"{side[0]}_hand"
    bend = np.array([0.0, 0, 0, PI / 2, 0])

    def at(*values) -> np.ndarray:
        generic(robot, part, np.array(values) + bend)
        return robot.data.site(hand).xpos.copy()

    here = at(0, 0, 0, 0, 0)
    upper = robot.data.body(part.limbs[0].body).xpos.copy()
    assert (here - upper)[0] > 0.1  # the flexed forearm points ahead
    assert (here - upper)[2] < -0.1  # below the shoulder
    assert (at(0.3, 0, 0, 0, 0) - here)[2] > 0.02  # pitch raises forward
    assert (at(0, 0.3, 0, 0, 0) - here)[1] * outward > 0.02  # roll moves away from the body
    assert (at(0, 0, 0.3, 0, 0) - here)[1] * outward < -0.02  # yaw turns the forearm inward
    assert (at(0, 0, 0, 0.3, 0) - here)[2] > 0.02  # elbow flexes


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_limb_frames_point_along_limb_and_away_from_trunk(name, side):
    robot, part = SimulatedRobot(name), description(name).part(side)
    generic(robot, part, np.zeros(5))
    outward = np.array([0, 1.0 if side == "left_arm" else -1.0, 0])
    for limb in part.limbs:
        turn = robot.data.body(limb.body).xmat.reshape(3, 3) @ limb.axes
        assert turn[:, 0] @ [0, 0, -1] > 0.97, limb.name
        assert turn[:, 2] @ outward > 0.97, limb.name
        assert np.linalg.det(limb.axes) == pytest.approx(1.0)


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_fields_move_skin_away_from_touch(name, side):
    robot, part = SimulatedRobot(name), description(name).part(side)
    for field in part.fields:
        limb = part.limb(field.limb)

        def place(angles, field=field, limb=limb):
            generic(robot, part, angles)
            body = robot.data.body(limb.body)
            turn = body.xmat.reshape(3, 3)
            inward = turn @ limb.axes @ np.array([0.0, *-field.centre[1:]])
            point = body.xpos + turn @ limb.to_body(field.centre)
            return point, inward / np.linalg.norm(inward)

        start, pushed = place(part.start)
        end, _ = place(part.start + field.motion)
        assert (end - start) @ pushed > 0.01, field.name
        low, high = part.mapping.limits
        moved = part.start + field.motion
        assert ((moved >= low - 1e-9) & (moved <= high + 1e-9) | ~part.mapping.available).all()


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_skin_lies_on_body(name, side):
    robot, part = SimulatedRobot(name), description(name).part(side)
    generic(robot, part, part.start)
    for field in part.fields:
        limb = part.limb(field.limb)
        body = robot.data.body(limb.body)
        turn = body.xmat.reshape(3, 3)
        out = turn @ limb.axes @ np.array([0.0, *field.centre[1:]])
        out /= np.linalg.norm(out)
        skin = body.xpos + turn @ limb.to_body(field.centre)
        hit = np.zeros(1, np.int32)
        # from a point so near that it is not in the trunk, which may be 8 mm away
        away = mujoco.mj_ray(robot.model, robot.data, skin + 0.006 * out, -out, None, 1, -1, hit)
        assert away - 0.006 == pytest.approx(0.0, abs=0.004), field.name


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_fields_cover_skin_of_every_limb(name, side):
    """63 to 79 % of the taxels of the upper arms, and 22 % of NAO's forearm, had no field.

    Of NAO's forearm 5 % still have none: neighbouring fields must not contain their centres.
    """
    part = description(name).part(side)
    for limb in part.limbs:
        share = 1.0 - covered(limb, part).mean()
        assert share <= (0.051 if limb.name == "lower_arm" else 0.0), limb.name


def test_robot_fields_are_the_same_on_both_sides_and_all_robots():
    """A long limb has a second row of fields."""
    named = [
        {
            field.name.removesuffix("_distal"): tuple(field.motion)
            for field in description(name).part(side).fields
        }
        for name, side in SIDES
    ]
    assert len(named[0]) == 8
    assert all(fields == named[0] for fields in named)


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_generic_chain_matches_simulation(name, side):
    robot, part = SimulatedRobot(name), description(name).part(side)
    low, high = part.mapping.limits
    for share in (0.2, 0.5, 0.9):
        angles = low + share * (high - low)
        generic(robot, part, angles)
        hand = robot.site(f"{side[0]}_hand")
        assert part.generic_chain.pose(angles)[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_robot_description_start_pose_matches_robot():
    for name, side in SIDES:
        robot, part = SimulatedRobot(name), description(name).part(side)
        for servo in part.servos:
            if servo.joint:
                device = servo.start * part.mapping.to_si[0]
                assert robot.robot.start.get(servo.joint, 0.0) == pytest.approx(device)


def test_robot_description_of_another_robot_does_not_fit():
    with pytest.raises(DescriptionError, match="the robot has no joint `LShoulderPitch`"):
        compare(description("nao_h21"), facts(ROBOTS["icub_v2"]()))
    with pytest.raises(KeyError):
        description("none")


@pytest.mark.parametrize("name", sorted(ROBOTS))
def test_robot_arm_held_away_from_body_has_no_contacts(name):
    """All over the range of its shoulder: shapes that overlap would stop it short of its limits."""
    robot, part = ROBOTS[name](), description(name).part("left_arm")
    spec = new_world()
    add_robot(spec, robot)
    model = spec.compile()
    data = mujoco.MjData(model)
    low, high = part.mapping.limits
    chance = np.random.default_rng(1)
    for _ in range(300):
        angles = low + (high - low) * chance.random(5)
        angles[1] = max(angles[1], 0.25)
        angles[2:4] = np.clip(angles[2], -0.3, 0.3), min(angles[3], 0.6)
        device = part.mapping.command(angles).values * part.mapping.to_si[part.mapping.present]
        names = [joint.rpartition("/")[2] for joint in part.joints]
        set_pose(model, data, robot, **dict(zip(names, device, strict=True)))
        assert not data.ncon, [model.geom(int(g)).name for g in data.contact.geom[0]]

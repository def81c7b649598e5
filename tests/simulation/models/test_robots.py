"""The simulated NAO and iCub: kinematics, limits, balance, and their generic arms."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description, facts
from robocomp_dsl.tactile.description.check import compare
from robocomp_dsl.tactile.errors import DescriptionError

PI = np.pi
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
TENTH_MM = 1e-4


class Simulated:
    def __init__(self, name: str, *, free: bool = False) -> None:
        self.robot = ROBOTS[name]()
        spec = new_world()
        if free:
            spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1])
        add_robot(spec, self.robot, free=free)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def pose(self, **angles: float) -> None:
        set_pose(self.model, self.data, self.robot, **angles)

    def in_root(self, position: np.ndarray) -> np.ndarray:
        root = self.data.body(self.robot.links[0].name)
        return root.xmat.reshape(3, 3).T @ (position - root.xpos)

    def site(self, name: str) -> np.ndarray:
        return self.in_root(self.data.site(name).xpos)


@pytest.fixture(scope="module", params=list(ROBOTS))
def simulated(request) -> Simulated:
    return Simulated(request.param)


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
    nao = Simulated("nao_h25")
    nao.pose(**nao_angles(side, angles))
    assert nao.site(f"{side.lower()}_hand") == pytest.approx(hand, abs=TENTH_MM)
    part = description("nao_h25").part("left_arm" if side == "L" else "right_arm")
    assert part.chain.pose(np.array(angles))[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_nao_points_match_published_kinematics():
    small = Simulated("nao_h21")
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
    icub = Simulated("icub_v2")
    icub.pose(**icub_angles(side, torso, arm))
    assert icub.site(f"{side}_hand") == pytest.approx(hand, abs=TENTH_MM)
    if not any(torso) and not any(arm[5:]):
        part = description("icub_v2").part("left_arm" if side == "l" else "right_arm")
        angles = np.deg2rad(arm[:5])
        assert part.chain.pose(angles)[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_icub_points_match_published_kinematics():
    icub = Simulated("icub_v2")
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


@pytest.mark.parametrize(
    ("name", "motors", "mass"),
    [("nao_h25", 25, 5.3054), ("nao_h21", 21, None), ("icub_v2", 23, None)],
)
def test_robot_motors_and_masses_match_data_sheets(name, motors, mass):
    robot = Simulated(name)
    assert robot.model.nu == len(robot.robot.motors) == motors
    if mass:
        assert robot.model.body_mass.sum() == pytest.approx(mass, abs=1e-4)


def test_robot_start_pose_is_free_of_contacts(simulated):
    simulated.pose()
    assert simulated.data.ncon == 0


def test_robot_arms_reach_their_limits_only(simulated):
    for joint in simulated.robot.motors:
        for sign, limit in ((-1, joint.low), (1, joint.high)):
            simulated.model.opt.gravity[:] = 0
            simulated.pose()
            simulated.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
            simulated.data.ctrl[:] = 0
            simulated.data.actuator(joint.name).ctrl[0] = sign * 0.2 * joint.effort
            for _ in range(2500):
                mujoco.mj_step(simulated.model, simulated.data)
            reached = simulated.data.joint(joint.name).qpos[0]
            assert reached == pytest.approx(limit, abs=0.03), joint.name
    simulated.data.ctrl[:] = 0
    simulated.model.opt.disableflags = 0
    simulated.model.opt.gravity[:] = (0, 0, -9.81)


def test_robot_motor_torque_is_limited(simulated):
    simulated.pose()
    simulated.data.ctrl[:] = 1e6
    mujoco.mj_forward(simulated.model, simulated.data)
    for joint in simulated.robot.motors:
        assert simulated.data.actuator(joint.name).force[0] == pytest.approx(joint.effort)
    simulated.data.ctrl[:] = 0


def hold(robot: Simulated, seconds: float) -> float:
    """Hold the start pose by stiff springs; the largest angle off at the end."""
    model, data = robot.model, robot.data
    joints = [model.joint(joint.name) for joint in robot.robot.motors]
    where = np.array([joint.qposadr[0] for joint in joints])
    speed = np.array([joint.dofadr[0] for joint in joints])
    goal = data.qpos[where].copy()
    effort = np.array([joint.effort for joint in robot.robot.motors])
    for _ in range(int(seconds / model.opt.timestep)):
        data.ctrl[:] = 30 * effort * (goal - data.qpos[where]) - effort * data.qvel[speed]
        mujoco.mj_step(model, data)
    return float(np.abs(goal - data.qpos[where]).max())


def test_fixed_robot_stays_in_place(simulated):
    simulated.pose()
    assert hold(simulated, 2.0) < 0.03
    assert np.abs(simulated.data.qvel).max() < 0.01
    assert simulated.data.ncon == 0


@pytest.mark.parametrize("name", ["nao_h21", "nao_h25"])
def test_free_nao_stands_on_its_feet(name):
    nao = Simulated(name, free=True)
    nao.pose()
    hold(nao, 2.0)
    torso = nao.data.body("torso")
    assert torso.xpos[2] == pytest.approx(0.333, abs=0.01)
    assert torso.xmat.reshape(3, 3)[2, 2] > 0.99


def test_nao_hip_yaws_share_a_motor():
    nao = Simulated("nao_h21")
    nao.pose(LHipYawPitch=-0.3)
    assert nao.data.joint("RHipYawPitch").qpos[0] == -0.3
    nao.data.actuator("LHipYawPitch").ctrl[0] = -3
    for _ in range(300):
        mujoco.mj_step(nao.model, nao.data)
    left, right = (nao.data.joint(f"{s}HipYawPitch").qpos[0] for s in "LR")
    assert left < -0.31
    assert right == pytest.approx(left, abs=0.01)


# the generic arms of the descriptions, on the simulated bodies

SIDES = [(name, f"{side}_arm") for name in ROBOTS for side in ("left", "right")]


def generic(simulated: Simulated, part, values) -> None:
    """Bring the simulated arm to generic angles."""
    mapping = part.mapping
    device = (values - mapping.sigma) / mapping.gamma * mapping.to_si
    named = {s.joint: v for s, v in zip(part.servos, device, strict=True) if s.joint}
    simulated.pose(**named)


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_generic_angles_mean_same_motion(name, side):
    robot, part = Simulated(name), description(name).part(side)
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
    robot, part = Simulated(name), description(name).part(side)
    generic(robot, part, np.zeros(5))
    outward = np.array([0, 1.0 if side == "left_arm" else -1.0, 0])
    for limb in part.limbs:
        turn = robot.data.body(limb.body).xmat.reshape(3, 3) @ limb.axes
        assert turn[:, 0] @ [0, 0, -1] > 0.97, limb.name
        assert turn[:, 2] @ outward > 0.97, limb.name
        assert np.linalg.det(limb.axes) == pytest.approx(1.0)


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_fields_move_skin_away_from_touch(name, side):
    robot, part = Simulated(name), description(name).part(side)
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
    robot, part = Simulated(name), description(name).part(side)
    generic(robot, part, part.start)
    for field in part.fields:
        limb = part.limb(field.limb)
        body = robot.data.body(limb.body)
        turn = body.xmat.reshape(3, 3)
        out = turn @ limb.axes @ np.array([0.0, *field.centre[1:]])
        out /= np.linalg.norm(out)
        skin = body.xpos + turn @ limb.to_body(field.centre)
        hit = np.zeros(1, np.int32)
        away = mujoco.mj_ray(robot.model, robot.data, skin + 0.02 * out, -out, None, 1, -1, hit)
        assert away - 0.02 == pytest.approx(0.0, abs=0.004), field.name


@pytest.mark.parametrize(("name", "side"), SIDES)
def test_robot_generic_chain_matches_simulation(name, side):
    robot, part = Simulated(name), description(name).part(side)
    low, high = part.mapping.limits
    for share in (0.2, 0.5, 0.9):
        angles = low + share * (high - low)
        generic(robot, part, angles)
        hand = robot.site(f"{side[0]}_hand")
        assert part.generic_chain.pose(angles)[:3, 3] == pytest.approx(hand, abs=TENTH_MM)


def test_robot_description_start_pose_matches_robot():
    for name, side in SIDES:
        robot, part = Simulated(name), description(name).part(side)
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

"""Skin on simulated bodies: the sum of the taxels is the force that is really there."""

from __future__ import annotations

from functools import cache

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.devices.skin import SkinSettings
from robocomp_dsl.simulation.devices.contact_forces import ContactRecorder
from robocomp_dsl.simulation.devices.skin import SimulatedSkin
from robocomp_dsl.simulation.robots.build import add_robot, new_world, quaternion
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description
from robocomp_dsl.simulation.robots.links import Link
from robocomp_dsl.simulation.world.world import World
from robocomp_dsl.tactile.description.model import GenericPart, Limb, RobotDescription
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import Imperfections

WEIGHT = 0.1 * 9.81
BALL = 0.03
FOREARMS = {"nao_h21": "LForeArm", "icub_v2": "l_forearm"}


@cache
def lower_arm(robot: str) -> tuple[Limb, Link, SkinGeometry]:
    part = description(robot).part("left_arm")
    limb = part.limb("lower_arm")
    patches = tuple(patch for patch in part.patches if patch.limb == "lower_arm")
    only = RobotDescription(robot, (GenericPart("left_arm", (), limbs=(limb,), patches=patches),))
    link = next(link for link in ROBOTS[robot]().links if link.name == FOREARMS[robot])
    return limb, link, SkinGeometry.of(only)


class Forearm:
    """A forearm of real mass on springs, a place of its skin turned upwards, and a ball on it."""

    def __init__(self, robot: str, x: float, theta: float, settings=None, tilt=0.0, **ball) -> None:
        limb, link, geometry = lower_arm(robot)
        shape = link.shapes[0]
        spec = new_world()
        spec.option.cone = ball.pop("cone", mujoco.mjtCone.mjCONE_PYRAMIDAL)
        down = np.array([-np.sin(tilt), 0.0, -np.cos(tilt)])
        spec.option.gravity = 9.81 * down
        turn = np.eye(4)
        turn[:3, :3] = upwards(limb, theta)
        body = spec.worldbody.add_body(name=limb.body, quat=quaternion(turn))
        body.explicitinertial = True
        body.mass, body.ipos, body.inertia = link.mass.mass, link.mass.centre, link.mass.inertia
        for axis in np.eye(3):
            body.add_joint(
                type=mujoco.mjtJoint.mjJNT_SLIDE,
                axis=turn[:3, :3].T @ axis,
                stiffness=[3000.0, 0, 0],
                damping=[60.0, 0, 0],
            )
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            size=[*shape.size, 0.0],
            pos=shape.pose[:3, 3],
            quat=quaternion(shape.pose),
            mass=0.0,
        )
        self.axis_point = turn[:3, :3] @ limb.to_body(np.array([x, 0, 0]))
        self.radius = shape.size[0]
        top = self.axis_point + np.array([0, 0, self.radius])
        marble = spec.worldbody.add_body(name="ball", pos=top + np.array([0, 0, BALL - 0.0005]))
        marble.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
        if tilt:
            marble.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0])
            marble.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 1, 0])
        marble.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[BALL, 0, 0], mass=0.1, **ball)
        self.skin = SimulatedSkin(geometry, settings)
        self.world = World(spec, [self.skin])
        self.limb, self.turn = limb, turn[:3, :3]

    def rest(self, seconds: float = 1.0) -> None:
        self.world.advance(seconds)

    @property
    def true_contact(self) -> np.ndarray:
        """The contact in the limb's frame, as the physics has it."""
        found = self.world.data.contact
        body = self.world.data.body(self.limb.body)
        here = body.xmat.reshape(3, 3).T @ (found.pos[0] - body.xpos)
        return self.limb.to_limb(here)


def upwards(limb: Limb, theta: float) -> np.ndarray:
    """The turn of the body that brings the place at `theta` to the top, the limb along x."""
    out = np.array([0.0, np.sin(theta), np.cos(theta)])
    frame = np.stack((np.array([1.0, 0, 0]), np.cross(out, [1.0, 0, 0]), out), axis=1)
    return (limb.axes @ frame).T


@pytest.mark.parametrize("robot", FOREARMS)
def test_skin_device_measures_weight_of_resting_ball_everywhere(robot):
    rng = np.random.default_rng(1)
    cone = lower_arm(robot)[0].cone
    sums, errors = [], []
    for _ in range(24):
        x = rng.uniform(cone.x0 + 0.1 * cone.length, cone.x1 - 0.1 * cone.length)
        forearm = Forearm(robot, x, rng.uniform(-np.pi, np.pi))
        forearm.rest()
        frame = forearm.skin.frame
        sums.append(frame.force.sum())
        centre = frame.force @ forearm.skin.geometry.points / frame.force.sum()
        errors.append(np.linalg.norm(centre - forearm.true_contact))
        assert frame.off_skin == 0.0
    assert np.array(sums) == pytest.approx(np.full(24, WEIGHT), rel=0.02)
    assert np.median(errors) < 0.003


def test_skin_device_contact_list_contains_ball():
    forearm = Forearm("icub_v2", 0.06, 0.7)
    forearm.rest()
    (touch,) = forearm.skin.contacts()
    assert touch.force == pytest.approx(WEIGHT, rel=0.02)
    assert touch.limb == "left_arm/lower_arm"
    assert touch.centre == pytest.approx(forearm.true_contact, abs=0.005)
    up = forearm.limb.axes.T @ forearm.turn.T @ [0, 0, 1]
    assert touch.normal @ up > 0.95


@pytest.mark.parametrize("cone", [mujoco.mjtCone.mjCONE_PYRAMIDAL, mujoco.mjtCone.mjCONE_ELLIPTIC])
def test_skin_device_measures_shear(cone):
    tilt = np.deg2rad(10)
    forearm = Forearm("icub_v2", 0.06, 0.7, tilt=tilt, cone=cone, friction=[1.0, 0.005, 0.0001])
    forearm.rest(0.5)
    frame = forearm.skin.frame
    assert frame.force.sum() == pytest.approx(WEIGHT * np.cos(tilt), rel=0.03)
    along = forearm.turn @ forearm.limb.axes @ frame.shear.sum(axis=0)
    assert along == pytest.approx([-WEIGHT * np.sin(tilt), 0, 0], abs=0.02)


def test_skin_device_separates_ball_off_skin():
    forearm = Forearm("icub_v2", 0.112, 0.0)
    forearm.rest()
    assert forearm.skin.frame.off_skin == pytest.approx(WEIGHT, rel=0.02)
    assert not forearm.skin.frame.force.any()
    assert forearm.skin.contacts() == []


def test_skin_device_frames_come_at_their_rate_with_mean():
    forearm = Forearm("nao_h21", 0.06, 0.0, SkinSettings(rate=50.0, shear=False))
    frames = []
    forearm.skin.subscribe(frames.append)
    assert forearm.skin.contacts() == []
    forearm.rest(1.0)
    assert len(frames) == 50
    assert [f.sequence for f in frames] == list(range(1, 51))
    assert np.diff([f.time for f in frames]) == pytest.approx(np.full(49, 0.02))
    assert frames[0].shear is None
    # an impulse is not lost between frames: force times time is weight times time
    felt = sum(f.force.sum() + f.off_skin for f in frames) * 0.02
    assert felt == pytest.approx(WEIGHT * 1.0, rel=0.03)


def test_skin_device_reports_two_touches_on_both_limbs():
    spec = new_world()
    robot = ROBOTS["icub_v2"]()
    add_robot(spec, robot, prefix="r1_")
    geometry = SkinGeometry.of(description("icub_v2"))
    skin = SimulatedSkin(geometry, prefix="r1_")
    pin = {}
    for limb in ("l_forearm", "r_upper_arm"):
        pin[limb] = spec.worldbody.add_body(name=f"pin_{limb}", mocap=True, pos=[0, 0, 2])
        pin[limb].add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.01, 0, 0])
    world = World(spec, [skin])
    for index, name in enumerate(("left_arm/lower_arm", "right_arm/upper_arm")):
        which = geometry.limbs.index(name)
        limb = geometry.frames[which]
        body = world.data.body("r1_" + limb.body)
        x = 0.07 if index == 0 else 0.11
        out = limb.to_body(np.array([x, 0.0, 0.0])), limb.axes[:, 2]
        radius = 0.035 if index == 0 else 0.04
        place = out[0] + (radius + 0.0095) * out[1]
        world.data.mocap_pos[index] = body.xpos + body.xmat.reshape(3, 3) @ place
    world.model.opt.gravity[:] = 0
    world.advance(0.02)
    assert {contact.limb for contact in skin.contacts()} == {
        "left_arm/lower_arm",
        "right_arm/upper_arm",
    }
    assert all(contact.force > 0.1 for contact in skin.contacts())


def test_skin_device_ignores_contact_without_force():
    text = """<mujoco><option gravity="0 0 0"/><worldbody><geom size=".1"/>
      <body name="limb" pos="0 0 .1999"><freejoint/><geom size=".1"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qvel[2] = 5.0  # so fast that nothing has to push
    recorder = ContactRecorder(
        model, np.array([-1, 0]), np.array([1]), np.zeros((1, 3)), np.eye(3)[None]
    )
    mujoco.mj_step(model, data)
    recorder.record(data)
    assert data.ncon == 1
    assert data.contact.efc_address[0] >= 0
    assert recorder.take() is None


def test_skin_device_raw_values_and_compensation_follow_electronics():
    settings = SkinSettings(
        raw=True,
        compensation=Compensation(smooth=False, add_threshold=1.0),
        imperfections=Imperfections(noise=0.02, drift=0.2),
    )
    forearm = Forearm("nao_h21", 0.06, 0.0, settings)
    ball = forearm.world.data.body("ball")
    forearm.world.data.qpos[-1] = 0.5  # lift the ball: nothing may touch while calibrating
    forearm.world.model.opt.gravity[:] = 0
    forearm.skin.calibrate(1.0)
    forearm.rest(1.1)
    frame = forearm.skin.frame
    assert frame.raw.dtype == np.uint8
    assert np.median(frame.raw) == pytest.approx(240, abs=1)
    assert forearm.skin.electronics.manager is not None
    assert not frame.force.any()
    forearm.world.data.qpos[-1] = 0.0
    forearm.world.data.qvel[:] = 0.0
    forearm.world.data.xfrc_applied[ball.id, 2] = -3.0
    forearm.rest(1.0)
    frame = forearm.skin.frame
    assert frame.raw.min() < 230
    assert frame.force.sum() == pytest.approx(3.0, rel=0.25)  # small forces fall to the threshold
    assert 0 < np.count_nonzero(frame.force) < 30


def test_skin_device_repeats_frames_with_same_seed():
    def frames(seed: int) -> np.ndarray:
        settings = SkinSettings(imperfections=Imperfections(noise=0.05, dead=0.1))
        forearm = Forearm("nao_h21", 0.06, 0.0, settings)
        forearm.skin.bind(forearm.world.model, forearm.world.data, np.random.default_rng(seed))
        forearm.rest(0.3)
        return forearm.skin.frame.force

    assert (frames(1) == frames(1)).all()
    assert (frames(1) != frames(2)).any()


def test_skin_device_of_forearm_may_cover_wrist():
    robot = ROBOTS["nao_h25"]()
    geometry = SkinGeometry.of(description("nao_h25"))
    spec = new_world()
    add_robot(spec, robot)
    skin = SimulatedSkin(geometry)
    World(spec, [skin])
    covered = {
        int(skin._limb_of_geom[skin._model.geom(name).id]) for name in ("LForeArm", "l_wrist")
    }
    assert covered == {geometry.limbs.index("left_arm/lower_arm")}


def test_skin_device_refuses_missing_or_shared_bodies():
    geometry = SkinGeometry.of(description("nao_h25"))
    with pytest.raises(SceneError, match="no body `LBicep`"):
        World(new_world(), [SimulatedSkin(geometry)])
    limb = lower_arm("nao_h21")[0]
    twice = RobotDescription(
        "r", (GenericPart("a", (), limbs=(limb,)), GenericPart("b", (), limbs=(limb,)))
    )
    spec = new_world()
    add_robot(spec, ROBOTS["nao_h21"]())
    with pytest.raises(SceneError, match="belongs to two limbs"):
        World(spec, [SimulatedSkin(SkinGeometry.of(twice))])

"""A ball of 100 g lies on forearms, turned every way: a subscriber hears what it weighs, and where.

One generated simulator in a process of its own holds many forearms of the real mass, each with a
skin, on springs; the frames come over zenoh.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import yaml
from worlds import rcgen, run, with_simulator

from robocomp_dsl.hardware.robots.build import new_world, quaternion
from robocomp_dsl.hardware.robots.catalog import ROBOTS, description, description_file
from robocomp_dsl.tactile.description.model import Limb

BALL = 0.03
COUNT = 16
FOREARMS = {"nao_h21": "LForeArm", "icub_v2": "l_forearm"}

HEAR = """
import json
skin = proxy(i.SKIN, "Skin")
geometry = skin.getGeometry()
frames = []
topic = Endpoint(i.SkinFrameProxy.INTERFACE, "client", "SkinFrame")
middleware.subscribe(topic, {"frame": frames.append}, Execution())
board = proxy(i.CONTROLBOARD, "ControlBoard")
board.setControlMode([one.name for one in board.getJoints()], i.ControlMode.Idle)
hand = proxy(i.SIMULATION, "Simulation")
hand.pause()
for _ in range(30):
    now = hand.step(100)
until(lambda: frames and frames[-1].time > now - 0.021)
frame, touches = frames[-1], skin.getContacts().contacts
told = {name: getattr(geometry, name).tolist() for name in ("limb", "x", "y", "z")}
told["names"] = [one.name for one in geometry.limbs]
told["force"] = frame.force.tolist()
told["off"] = frame.offSkin
told["touches"] = sorted((one.limb, one.force) for one in touches)
print(json.dumps(told))
"""


def lower_arm(robot: str) -> Limb:
    return description(robot).part("left_arm").limb("lower_arm")


def upwards(limb: Limb, theta: float) -> np.ndarray:
    """The turn of the body that brings the place at `theta` to the top, the limb along x."""
    out = np.array([0.0, np.sin(theta), np.cos(theta)])
    frame = np.stack((np.array([1.0, 0, 0]), np.cross(out, [1.0, 0, 0]), out), axis=1)
    return (limb.axes @ frame).T


def places(robot: str) -> np.ndarray:
    """Where the balls lie: x along the limb, theta around it."""
    cone, rng = lower_arm(robot).cone, np.random.default_rng(7)
    x = rng.uniform(cone.x0 + 0.1 * cone.length, cone.x1 - 0.1 * cone.length, COUNT)
    return np.column_stack((x, rng.uniform(-np.pi, np.pi, COUNT)))


def world(robot: str) -> str:
    """The forearms half a metre apart, with a ball on each."""
    limb = lower_arm(robot)
    link = next(one for one in ROBOTS[robot]().links if one.name == FOREARMS[robot])
    shape, spec = link.shapes[0], new_world()
    for k, (x, theta) in enumerate(places(robot)):
        at, turn = np.array([0.5 * k, 0.0, 0.0]), np.eye(4)
        turn[:3, :3] = upwards(limb, theta)
        body = spec.worldbody.add_body(name=f"arm{k}", pos=at, quat=quaternion(turn))
        body.explicitinertial = True
        body.mass, body.ipos, body.inertia = link.mass.mass, link.mass.centre, link.mass.inertia
        for axis in np.eye(3):
            slide, along = mujoco.mjtJoint.mjJNT_SLIDE, turn[:3, :3].T @ axis
            body.add_joint(type=slide, axis=along, stiffness=[3000.0, 0, 0], damping=[60.0, 0, 0])
        capsule, pose = mujoco.mjtGeom.mjGEOM_CAPSULE, shape.pose
        body.add_geom(
            type=capsule, size=[*shape.size, 0.0], pos=pose[:3, 3], quat=quaternion(pose), mass=0.0
        )
        above = np.array([0, 0, shape.size[0] + BALL - 0.0005])
        on_axis = at + turn[:3, :3] @ limb.to_body(np.array([x, 0, 0]))
        ball = spec.worldbody.add_body(name=f"ball{k}", pos=on_axis + above)
        ball.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
        ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[BALL, 0, 0], mass=0.1)
    spec.compile()
    return str(spec.to_xml())


def touch(robot: str) -> str:
    """The skin of the robot's lower arm on each of the forearms."""
    given = yaml.safe_load(description_file(robot).read_text())["parts"]["left_arm"]
    limb = {k: v for k, v in given["limbs"]["lower_arm"].items() if k != "covers"}
    (patch,) = (one for one in given["skin"] if one["limb"] == "lower_arm")
    parts: dict[str, Any] = {}
    for k in range(COUNT):
        one = patch | {"patch": f"skin{k}", "first_id": 1000 * k}
        parts[f"arm{k}"] = {
            "servos": [],
            "limbs": {"lower_arm": limb | {"body": f"arm{k}"}},
            "skin": [one],
        }
    return str(yaml.safe_dump({"robot": "forearms", "parts": parts}, sort_keys=False))


@pytest.mark.parametrize("robot", FOREARMS)
def test_a_ball_weighs_what_it_weighs_wherever_it_lies(robot: str, tmp_path: Path) -> None:
    (tmp_path / "arms.xml").write_text(world(robot))
    (tmp_path / "arms.yaml").write_text(touch(robot))
    done = rcgen("simulator", "arms.xml", "--tactile", "arms.yaml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    code = with_simulator("zenoh", HEAR)
    told = json.loads(
        run(tmp_path / "arms_simulator", code, "zenoh", tmp_path.name, "arms_simulator")
    )
    limb, force = np.array(told["limb"]), np.array(told["force"])
    points = np.column_stack([told[axis] for axis in "xyz"])
    sums = np.bincount(limb, force, COUNT)
    assert told["names"] == [f"arm{k}/lower_arm" for k in range(COUNT)]
    assert sums == pytest.approx(np.full(COUNT, 0.981), rel=0.02)
    assert told["off"] == 0.0
    touched, felt = np.array(told["touches"]).T  # where skin has gaps, one ball is two touches
    assert np.bincount(touched.astype(int), felt, COUNT) == pytest.approx(sums, rel=1e-5)
    radius = (
        next(one for one in ROBOTS[robot]().links if one.name == FOREARMS[robot]).shapes[0].size[0]
    )
    errors = []
    for k, (x, theta) in enumerate(places(robot)):
        true = np.array([x, radius * np.sin(theta), radius * np.cos(theta)])
        errors.append(np.linalg.norm(force[limb == k] @ points[limb == k] / sums[k] - true))
    assert np.median(errors) < 0.003

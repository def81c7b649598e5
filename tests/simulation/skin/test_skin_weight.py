"""A ball of 100 g lies on forearms, turned every way: a subscriber hears what it weighs, and where.

One generated simulator in a process of its own holds many forearms of the real mass, each with a
skin, on springs; the frames come over zenoh. Balls are as small as a marble and as large as a head.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import yaml

from robocomp_dsl.simulation.robots.build import new_world, quaternion
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description, description_file
from robocomp_dsl.simulation.robots.links import Link
from robocomp_dsl.tactile.description.model import Limb
from tests.simulation.served_worlds import rcgen, run, with_simulator

BALLS = (0.008, 0.03, 0.1)
COUNT = 30
FOREARMS = {
    "nao_h21": ("LForeArm",),
    "nao_h25": ("LForeArm", "l_wrist"),
    "icub_v2": ("l_forearm",),
}

HEAR = """
import json
skin = proxy(i.SKIN, "Skin")
geometry = skin.getGeometry()
frames = []
topic = Endpoint(i.SkinFrameProxy.INTERFACE, "client", "SkinFrame")
middleware.subscribe(topic, {"frame": frames.append}, CallbackGroup())
board = proxy(i.CONTROLBOARD, "ControlBoard")
board.setControlMode([joint.name for joint in board.getJoints()], i.ControlMode.Idle)
hand = proxy(i.SIMULATION, "Simulation")
hand.pause()
for _ in range(30):
    now = hand.step(100)
wait_until(lambda: frames and frames[-1].time > now - 0.021)
frame, touches = frames[-1], skin.getContacts().contacts
message = {name: getattr(geometry, name).tolist() for name in ("limb", "x", "y", "z")}
message["names"] = [limb.name for limb in geometry.limbs]
message["force"] = frame.force.tolist()
message["off"] = frame.offSkin
message["touches"] = sorted((touch.limb, touch.force) for touch in touches)
print(json.dumps(message))
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


def ball(k: int) -> float:
    """The radius of the ball number `k`."""
    return BALLS[k % len(BALLS)]


def links(robot: str) -> list[Link]:
    """What the skin is on: the forearm, and what hangs on it."""
    result = {link.name: link for link in ROBOTS[robot]().links}
    return [result[name] for name in FOREARMS[robot]]


def world(robot: str) -> str:
    """The forearms half a metre apart, with a ball on each."""
    limb, spec, radius = lower_arm(robot), new_world(), surface(robot)
    for k, (x, theta) in enumerate(places(robot)):
        at, turn = np.array([0.5 * k, 0.0, 0.0]), np.eye(4)
        turn[:3, :3] = upwards(limb, theta)
        turn[:3, 3] = at
        arm = hang(spec.worldbody, turn, f"arm{k}", links(robot))
        for axis in np.eye(3):
            slide, along = mujoco.mjtJoint.mjJNT_SLIDE, turn[:3, :3].T @ axis
            arm.add_joint(type=slide, axis=along, stiffness=[3000.0, 0, 0], damping=[60.0, 0, 0])
        above = np.array([0, 0, radius + ball(k) - 0.0005])
        on_axis = at + turn[:3, :3] @ limb.to_body(np.array([x, 0, 0]))
        body = spec.worldbody.add_body(name=f"ball{k}", pos=on_axis + above)
        body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[ball(k), 0, 0], mass=0.1)
    spec.compile()
    return str(spec.to_xml())


def hang(parent: Any, pose: np.ndarray, name: str, chain: list[Link]) -> Any:
    """The first link at `pose` in `parent`, the next one fixed to it, as the robot is at zero."""
    link, *others = chain
    body = parent.add_body(name=name, pos=pose[:3, 3], quat=quaternion(pose))
    body.explicitinertial = True
    body.mass, body.ipos, body.inertia = link.mass.mass, link.mass.centre, link.mass.inertia
    (shape,) = link.shapes
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_CAPSULE,
        size=[*shape.size, 0.0],
        pos=shape.pose[:3, 3],
        quat=quaternion(shape.pose),
        mass=0.0,
    )
    if others:
        hang(body, others[0].pose, f"{name}_on", others)
    return body


def surface(robot: str) -> float:
    """How far from its axis the forearm is touched."""
    return max(link.shapes[0].size[0] for link in links(robot))


def touch(robot: str) -> str:
    """The skin of the robot's lower arm on each of the forearms."""
    values = yaml.safe_load(description_file(robot).read_text())["parts"]["left_arm"]
    limb = values["limbs"]["lower_arm"]
    (patch,) = (patch for patch in values["skin"] if patch["limb"] == "lower_arm")
    parts: dict[str, Any] = {}
    for k in range(COUNT):
        copy = patch | {"patch": f"skin{k}", "first_id": 1000 * k}
        parts[f"arm{k}"] = {
            "servos": [],
            "limbs": {"lower_arm": limb | on_bodies(robot, f"arm{k}")},
            "skin": [copy],
        }
    return str(yaml.safe_dump({"robot": "forearms", "parts": parts}, sort_keys=False))


def on_bodies(robot: str, name: str) -> dict[str, Any]:
    """The body of the limb, and those that its skin covers besides."""
    covers = [f"{name}_on"] if len(links(robot)) > 1 else []
    return {"body": name, "covers": covers}


@pytest.mark.parametrize("robot", FOREARMS)
def test_skin_measures_weight_of_ball_everywhere(robot: str, tmp_path: Path) -> None:
    (tmp_path / "arms.xml").write_text(world(robot))
    (tmp_path / "arms.yaml").write_text(touch(robot))
    done = rcgen("simulator", "arms.xml", "--tactile", "arms.yaml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    code = with_simulator("zenoh", HEAR)
    received = json.loads(
        run(tmp_path / "arms_simulator", code, "zenoh", tmp_path.name, "arms_simulator")
    )
    limb, force = np.array(received["limb"]), np.array(received["force"])
    points = np.column_stack([received[axis] for axis in "xyz"])
    sums = np.bincount(limb, force, COUNT)
    assert received["names"] == [f"arm{k}/lower_arm" for k in range(COUNT)]
    assert sums == pytest.approx(np.full(COUNT, 0.981), rel=0.02)
    assert received["off"] == 0.0
    touched, felt = np.array(received["touches"]).T  # where skin has gaps, one ball is two touches
    assert np.bincount(touched.astype(int), felt, COUNT) == pytest.approx(sums, rel=1e-5)
    errors = np.empty(COUNT)
    for k, (x, theta) in enumerate(places(robot)):
        true = np.array([x, *(surface(robot) * np.array([np.sin(theta), np.cos(theta)]))])
        errors[k] = np.linalg.norm(force[limb == k] @ points[limb == k] / sums[k] - true)
    for i, radius in enumerate(BALLS):
        assert np.median(errors[i :: len(BALLS)]) < 0.003, radius

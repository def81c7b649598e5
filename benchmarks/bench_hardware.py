"""The transform tree against its goals, and how much faster than time the demo's world runs."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from robocomp_dsl.hardware.description.scene import Box, Frame, Motion, Scene
from robocomp_dsl.hardware.devices.differential_robot import Mechanics
from robocomp_dsl.hardware.devices.laser import LaserSettings
from robocomp_dsl.hardware.kinematics.frame_layout import FrameLayout
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.simulation.devices.differential_robot import DifferentialRobot
from robocomp_dsl.simulation.devices.laser import Laser
from robocomp_dsl.simulation.models.model_to_transforms import mirror
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.scene.room import Room, Wall
from robocomp_dsl.simulation.scene.scene_spec import build_spec
from robocomp_dsl.simulation.world.world import World


def best(action: Callable[[], Any], count: int, rounds: int = 9) -> float:
    """Microseconds of one call in the quietest of several rounds."""
    taken = []
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(count):
            action()
        taken.append((time.perf_counter() - start) / count * 1e6)
    return min(taken)


def tree(count: int) -> TransformTree:
    """Frames that branch as a robot's do: each stands in one of the 100 before it."""
    random = np.random.default_rng(0)
    transforms = TransformTree()
    for i in range(count):
        parent = "root" if i == 0 else f"f{int(random.integers(max(0, i - 100), i))}"
        place, turn = random.uniform(-100, 100, 3), random.uniform(-3, 3, 3)
        motion = Motion("hinge", "z")
        transforms.add(Frame(f"f{i}", parent, tuple(place.tolist()), tuple(turn.tolist()), motion))
    return transforms


def layout(count: int) -> FrameLayout:
    """The arrays of a tree of 14 levels."""
    random = np.random.default_rng(1)
    levels = [[("f0", "", random.uniform(-3, 3, 6).tolist())]]
    size = (count - 1) // 13
    for depth in range(13):
        above = [name for name, _, _ in levels[-1]]
        names = [f"f{depth}.{i}" for i in range(size if depth else count - 1 - 12 * size)]
        pick = random.integers(len(above), size=len(names))
        levels.append(
            [
                (n, above[int(k)], random.uniform(-3, 3, 6).tolist())
                for n, k in zip(names, pick, strict=True)
            ]
        )
    return FrameLayout(levels)


def run() -> Iterator[dict[str, Any]]:
    """The figures."""
    frames = tree(500)
    cached = best(lambda: frames.transform((1.0, 2.0, 3.0), "f400", "f7"), 20_000)
    yield {
        "name": "transform of a point, nothing moved",
        "value": cached,
        "unit": "µs",
        "goal": 1.0,
    }

    yield {
        "name": "world poses of 500 frames, all anew",
        "value": best(layout(500).refresh, 300),
        "unit": "µs",
        "goal": 100.0,
    }
    yield from mirrors()
    yield {
        "name": "simulated base with a 361-ray laser at 20 Hz, times real time",
        "value": world_speed(),
        "unit": "x",
        "goal": 10.0,
        "better": "higher",
    }


def mirrors() -> Iterator[dict[str, Any]]:
    """The tree of a compiled humanoid, and a world of very many nodes."""
    spec = new_world()
    add_robot(spec, ROBOTS["nao_h25"]())
    model = spec.compile()
    found, random = mirror(model), np.random.default_rng(0)
    positions = random.uniform(-1, 1, (2, model.nq))

    def follow() -> None:
        for qpos in positions:
            found.follow(qpos)
            found.tree.matrix("l_hand", "r_hand")

    yield {
        "name": f"all {model.njnt} joints of a humanoid moved, hand seen from hand",
        "value": best(follow, 100) / 2,
        "unit": "µs",
    }
    start = time.perf_counter()
    build_spec(many(10_000))[0].compile()
    yield {
        "name": "MuJoCo model of a world of 10 000 nodes (5000 frames, 5000 boxes)",
        "value": time.perf_counter() - start,
        "unit": "s",
    }


def many(count: int) -> Scene:
    """Half frames that branch, a third of them joints, and half boxes."""
    random = np.random.default_rng(0)
    frames = [Frame("root", "")]
    for i in range(count // 2):
        parent = frames[int(random.integers(max(0, i - 100), i + 1))].id
        motion = Motion("hinge", "z") if i % 3 == 0 else None
        frames.append(Frame(f"f{i}", parent, (10.0, 20.0, 30.0), motion=motion))
    boxes = tuple(Box(f"b{i}", f"f{i}", (5.0, 5.0, 5.0)) for i in range(count // 2))
    return Scene(tuple(frames), boxes)


def world_speed() -> float:
    """Simulated seconds per second."""
    robot, laser = DifferentialRobot(Mechanics()), Laser(LaserSettings(noise=5.0))
    room = Room(walls=(Wall(-9000, 6000, 9000, 6000, 100, 1000),))
    world = World(room.spec(), (robot, laser))
    robot.set_speed(200, 0.5)
    return 1e6 / best(lambda: world.advance(1.0), 1, rounds=5)

"""What 4000 taxels cost on a humanoid at 1 kHz.

In the library, iCub with 23 joints and 40 fingers that press on its arms: the same world with and
without skin takes turns; all figures are CPU time. As a generated simulator, NAO with 31 joints in
a process of its own, heard over zenoh at 50 Hz of simulated time: how fast it lives, how long a
touch takes to its subscriber, and what reading a frame costs there.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import mujoco
import numpy as np

from benchmarks.skin_heard import interfaces, latencies, pace
from benchmarks.skin_world import make
from benchmarks.urgent import urgent
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.devices.skin import SimulatedSkin
from robocomp_dsl.simulation.robots.boards import whole_robot
from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description
from robocomp_dsl.simulation.world.world import World
from robocomp_dsl.tactile.description.model import GenericPart, Limb, Patch, RobotDescription
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.layout import place_taxels
from robocomp_dsl.tactile.skin.normalise import Sensitivity

ROUNDS = 12
SPAN = 0.1
"""Simulated seconds of one round."""

FINGERS = 10
"""On each of the four limbs."""

TAPS = 300
ROUNDS_OF_READING = 1000


def _dense(part: GenericPart, first: int) -> GenericPart:
    """The part with 1000 taxels on each limb."""
    patches = []
    for i, limb in enumerate(part.limbs):
        x = np.linspace(limb.cone.x0 + 0.004, limb.cone.x1 - 0.004, 25)
        theta = np.linspace(-np.pi, np.pi, 40, endpoint=False)
        places = np.stack(np.meshgrid(x, theta, indexing="ij"), axis=-1).reshape(-1, 2)
        placed = place_taxels(limb.cone, places)
        ids = tuple(range(first + 1000 * i, first + 1000 * (i + 1)))
        patches.append(
            Patch(f"{part.name}{i}", limb.name, ids, placed.points, placed.normals, Sensitivity())
        )
    return replace(part, patches=tuple(patches))


def _world(skin: SimulatedSkin | None, fingers: bool) -> World:
    robot = ROBOTS["icub_v2"]()
    spec = new_world()
    add_robot(spec, robot)
    for k in range(4 * FINGERS if fingers else 0):
        tip = spec.worldbody.add_body(name=f"tip{k}", mocap=True, pos=[0, k, 5])
        tip.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.008, 0, 0])
    board = SimulatedBoard(whole_robot(robot))
    world = World(spec, [board, skin] if skin else [board])
    set_pose(world.model, world.data, robot)
    world.advance(0.001)
    board.commands.set_mode(None, Mode.POSITION)
    if fingers:
        _press(world)
    return world


def _press(world: World) -> None:
    """Put the fingers on the limbs, a millimetre deep."""
    limbs = [limb for part in description("icub_v2").parts for limb in part.limbs]
    rng = np.random.default_rng(3)
    for k, place in enumerate(rng.uniform(size=(4 * FINGERS, 2))):
        world.data.mocap_pos[k] = _outside(world, limbs[k // FINGERS], *place)


def _outside(world: World, limb: Limb, along: float, around: float) -> Any:
    theta = 2 * np.pi * around
    out = np.array([0.0, np.sin(theta), np.cos(theta)])
    axis = np.array([limb.cone.x0 + along * limb.cone.length, 0, 0])
    radius = 0.035 if limb.name == "lower_arm" else 0.040
    body = world.data.body(limb.body)
    turn = body.xmat.reshape(3, 3)
    return body.xpos + turn @ limb.to_body(axis + out * (radius + 0.007))


def _cpu(world: World) -> float:
    start = time.thread_time()
    world.advance(SPAN)
    return time.thread_time() - start


def run() -> Iterator[dict[str, Any]]:
    """All rows."""
    yield from _library()
    for fingers in (1, 10):
        with tempfile.TemporaryDirectory() as folder:
            simulator = make(Path(folder), fingers)
            yield from _paced(simulator, 4 * fingers)
            if fingers == 1:
                yield from _tapped(simulator, Path(folder) / "taps")
                yield from _decoded(simulator)


def _paced(simulator: Path, fingers: int) -> Iterator[dict[str, Any]]:
    """The quietest of all windows: what else the machine does is no part of it."""
    found = pace(simulator)
    name = f"generated simulator, 4000 taxels, 31 joints, {fingers} fingers, over zenoh"
    higher: dict[str, Any] = {"unit": "x", "better": "higher"}
    goal = {"goal": 5.0} if fingers == 4 else {}
    yield {"name": f"{name}: real-time factor", "value": max(found.wall), **higher, **goal}
    yield {"name": "  median of all windows", "value": median(found.wall), **higher}
    yield {"name": "  on one core, by CPU time of all threads", "value": max(found.cpu), **higher}
    yield {"name": "  frames lost", "value": found.lost, "unit": "", "goal": 0}


def _tapped(simulator: Path, file: Path) -> Iterator[dict[str, Any]]:
    with urgent() as first:
        found = latencies(simulator, file, TAPS)
    yield {
        "name": f"the machine's own lateness{' at real-time priority' if first else ''}, p99",
        "value": float(np.percentile(found.lateness, 99)),
        "unit": "ms",
    }
    name = "contact in the physics to subscriber's handler, frame period included"
    for share, goal in ((50, None), (90, None), (99, 25.0)):
        value = float(np.percentile(found.way, share))
        yield {"name": f"{name}, p{share}", "value": value, "unit": "ms", "goal": goal}
    yield {
        "name": "  touches that were not heard of",
        "value": found.count - len(found.way),
        "unit": "",
    }


def _decoded(simulator: Path) -> Iterator[dict[str, Any]]:
    types, random = interfaces(simulator), np.random.default_rng(1)
    force, x, y, z = random.random((4, 4000)).astype(np.float32)
    raw = random.integers(0, 256, 4000).astype(np.uint8)
    operation = types.SkinFrameProxy.INTERFACE.operations[0]
    calls = {}
    for name, fields in (
        ("forces", {}),
        ("forces, shear and raw values", {"shearX": x, "shearY": y, "shearZ": z, "raw": raw}),
    ):
        sent = operation.encode_request((types.Frame(force=force, geometry=1, **fields),))
        calls[name] = partial(operation.decode_request, sent)
    for name, value in _quietest(calls).items():
        what = f"reading a frame of 4000 taxels: {name}"
        yield {"name": what, "value": value, "unit": "us", "goal": 5.0}


def _quietest(calls: dict[str, Callable[[], Any]]) -> dict[str, float]:
    """Each call in its quietest round [us]; they take turns, for others share the processor."""
    best = dict.fromkeys(calls, np.inf)
    for _ in range(ROUNDS_OF_READING):
        for name, call in calls.items():
            start = time.perf_counter()
            for _ in range(100):
                call()
            best[name] = min(best[name], (time.perf_counter() - start) / 100 * 1e6)
    return best


def _library() -> list[dict[str, Any]]:
    """Real-time factors, and what the skin adds."""
    read = description("icub_v2")
    parts = tuple(_dense(part, 2000 * i) for i, part in enumerate(read.parts))
    skin = SimulatedSkin(SkinGeometry.of(RobotDescription("dense", parts)))
    idle = SimulatedSkin(skin.geometry)
    worlds = {
        "skin, 40 fingers": _world(skin, True),
        "no skin, 40 fingers": _world(None, True),
        "skin, no touch": _world(idle, False),
        "no skin, no touch": _world(None, False),
    }
    spent: dict[str, list[float]] = {name: [] for name in worlds}
    for _ in range(ROUNDS):
        for name, world in worlds.items():
            spent[name].append(_cpu(world))
    best = {name: min(times) for name, times in spent.items()}
    pairs = zip(spent["skin, 40 fingers"], spent["no skin, 40 fingers"], strict=True)
    frame = skin.frame
    touched = int(np.count_nonzero(frame.force)) if frame else 0
    return [
        {"name": "taxels", "value": skin.geometry.size, "unit": ""},
        {"name": "taxels touched", "value": touched, "unit": ""},
        *(
            {
                "name": f"real-time factor, {name}",
                "value": SPAN / value,
                "unit": "x",
                "goal": 5.0 if name.startswith("skin") else None,
                "better": "higher",
            }
            for name, value in best.items()
        ),
        {
            "name": "time with 40 fingers, skin against no skin",
            "value": median(a / b for a, b in pairs),
            "unit": "x",
        },
        {
            "name": "making one frame of 4000 taxels under 40 fingers",
            "value": _frame_cost(skin) * 1e6,
            "unit": "us",
            "goal": 1000.0,
        },
    ]


def _frame_cost(skin: SimulatedSkin) -> float:
    """The best of several: the one step in 20 that makes a frame of all their contacts."""
    costs = []
    for _ in range(30):
        cycle = []
        for _ in range(20):
            start = time.thread_time()
            skin.after_step(0.001)
            cycle.append(time.thread_time() - start)
        costs.append(max(cycle))
    return min(costs)

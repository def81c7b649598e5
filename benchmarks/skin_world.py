"""A generated simulator for the benchmarks of skin: NAO with 4000 taxels and 31 joints.

In: a folder, and how many fingers press on each of the four limbs. Out: the component, made by
`rcgen simulator` from a world in MJCF and a description of touch. One more finger taps on a forearm
when it is told to, and writes down when it met the skin.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.robots.catalog import description, description_file
from robocomp_dsl.simulation.robots.export import WORLDS, text
from robocomp_dsl.tactile.description.model import Limb

ROBOT = "nao_h25"
TIP = 0.008
DEPTH = 0.001
RINGS, AROUND = 25, 40
"""Taxels of each limb: 1000."""

WORKER = '''"""The simulator, and a finger that taps and tells when it met the skin."""

from __future__ import annotations

import os
from time import monotonic_ns

import numpy as np

from nao_simulator_generated.simulator import Simulator

PERIOD, DOWN = 0.0873, 0.03


class SpecificWorker(Simulator):
    """Taps of 30 ms come every 87.3 ms, so that they meet all phases of the frames."""

    def initialize(self) -> None:
        super().initialize()
        if "TAPS" in os.environ:
            with self.simulation.lock:
                self.tap(os.environ["TAPS"])

    def tap(self, file: str) -> None:
        world = self.simulation.world
        model, data = world.model, world.data
        tapper = model.body("tapper")
        mocap, geom = int(tapper.mocapid[0]), int(tapper.geomadr[0])
        away = data.mocap_pos[mocap].copy()
        near = away + np.array(model.body_user[tapper.id][:3])
        log = open(file, "w", buffering=1)
        recorder = self.simulation.branch.devices["nao_h25"]._recorder
        record, touched = recorder.record, False

        def tapping(data: object) -> None:
            nonlocal touched
            record(data)
            touches = bool((world.data.contact.geom == geom).any())
            if touches and not touched:
                log.write(f"{world.data.time} {monotonic_ns()}\\n")
            touched = touches
            down = world.data.time > 1.0 and world.data.time % PERIOD < DOWN
            world.data.mocap_pos[mocap] = near if down else away

        recorder.record = tapping
'''


def make(folder: Path, fingers: int) -> Path:
    """The component in `folder`, with so many fingers on each limb."""
    (folder / "nao.xml").write_text(_world(fingers))
    (folder / "tactile.yaml").write_text(_dense(description_file(ROBOT).read_text()))
    rcgen = Path(sys.executable).with_name("rcgen")
    command = [rcgen, "simulator", "nao.xml", "--tactile", "tactile.yaml"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    simulator = folder / "nao_simulator"
    (simulator / "specificworker.py").write_text(WORKER)
    return simulator


def _dense(text: str) -> str:
    """The description with 1000 taxels on each limb."""
    import yaml  # noqa: PLC0415 - only here

    read = yaml.safe_load(text)
    for number, (name, part) in enumerate(read["parts"].items()):
        patches = []
        for i, limb in enumerate(description(ROBOT).part(name).limbs):
            x = np.linspace(limb.cone.x0 + 0.004, limb.cone.x1 - 0.004, RINGS)
            theta = np.linspace(-np.pi, np.pi, AROUND, endpoint=False)
            points = [[float(a), float(b)] for a in x for b in theta]
            first = 1000 * (2 * number + i)
            sensor = {"gain": 0.05, "floor": 2, "saturation": 240}
            patch = {"patch": f"{name}_{limb.name}", "limb": limb.name, "first_id": first}
            patches.append(patch | {"points": points, "sensitivity": sensor})
        part["skin"] = patches
    return str(yaml.safe_dump(read))


def _world(fingers: int) -> str:
    """The world of the robot, three more joints, and fingers that stay where they press."""
    world = next(candidate for candidate in WORLDS if candidate.robot == ROBOT)
    spec = mujoco.MjSpec.from_string(text(world))
    spec.nuser_body = 3
    _add_pointer(spec)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    rng = np.random.default_rng(3)
    limbs = [limb for part in description(ROBOT).parts for limb in part.limbs]
    for i, limb in enumerate(limbs):
        for k, (along, around) in enumerate(rng.uniform(0.1, 0.9, (fingers, 2))):
            place, _ = _outside(model, data, limb, along, 2 * np.pi * around)
            _add_tip(spec, f"tip{i}_{k}", place)
    place, out = _outside(model, data, limbs[1], 0.5, 0.0)
    _add_tip(spec, "tapper", place + 0.02 * out).userdata = -0.02 * out
    spec.compile()
    return str(spec.to_xml())


def _add_tip(spec: Any, name: str, place: Any) -> Any:
    tip = spec.worldbody.add_body(name=name, mocap=True, pos=place)
    tip.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[TIP, 0, 0])
    return tip


def _add_pointer(spec: Any) -> None:
    body = spec.worldbody.add_body(name="pointer", pos=[1.0, 1.0, 0.5], gravcomp=1.0)
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[TIP, 0, 0], mass=0.1)
    for axis, direction in zip("xyz", np.eye(3), strict=True):
        name = f"pointer_{axis}"
        slide = mujoco.mjtJoint.mjJNT_SLIDE
        body.add_joint(name=name, type=slide, axis=direction, damping=[2.0, 0, 0])
        spec.add_actuator(
            name=name,
            target=name,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            ctrlrange=[-20, 20],
            ctrllimited=True,
        )


def _outside(model: Any, data: Any, limb: Limb, along: float, around: float) -> tuple[Any, Any]:
    """Where a tip is that presses on a limb, and the way out from there."""
    body = data.body(limb.body)
    turn = body.xmat.reshape(3, 3)
    axis = np.array([limb.cone.x0 + along * limb.cone.length, 0.0, 0.0])
    out = turn @ limb.axes @ np.array([0.0, np.sin(around), np.cos(around)])
    start = body.xpos + turn @ limb.to_body(axis) + 0.1 * out
    hit = np.array([-1], np.int32)
    far = mujoco.mj_ray(model, data, start, -out, None, 1, -1, hit)
    return start - out * (far - TIP + DEPTH), out

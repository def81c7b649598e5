"""The modules of the touch demo, and a robot with a finger and a recording to try them on."""

import importlib
import sys
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np

from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from tests.demo.component_modules import COMPONENTS

NAMES = ("recording", "path_planner", "metrics", "body", "topic_buffer", "skin_map", "colours",
         "photograph", "panel", "curves", "figure", "pressing", "deployed", "failure",
         "robot_under_test",
         "live", "subject", "report", "demo")  # fmt: skip
ARM = "left_arm"
STEP = 0.02
PRESSED, FELT, MOVED, FREE = 1.0, 1.06, 1.12, 1.20
"""s: the finger sets off, the first frame that feels it, the first motion, the first free frame."""


@cache
def demo() -> SimpleNamespace:
    """The demo's modules by name; they are no package, and others may have modules called so."""
    folder = str(COMPONENTS / "touch_demo")
    before = {name: sys.modules.pop(name) for name in NAMES if name in sys.modules}
    sys.path.insert(0, folder)
    try:
        return SimpleNamespace(**{name: importlib.import_module(name) for name in NAMES})
    finally:
        sys.path.remove(folder)
        for name in NAMES:
            sys.modules[f"touch_demo.{name}"] = sys.modules.pop(name)
        sys.modules.update(before)


def world(folder: Path, name: str = "nao_h25") -> Path:
    """A robot and a finger on three slides, as a file."""
    spec = new_world()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
    add_robot(spec, ROBOTS[name]())
    finger = spec.worldbody.add_body(name="finger", pos=[0.6, 0.6, 0.5], gravcomp=1)
    for axis, letter in zip(np.eye(3), "xyz", strict=True):
        joint = f"finger_{letter}"
        finger.add_joint(name=joint, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis, range=[-1, 1])
    finger.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.008, 0, 0], mass=0.05)
    spec.compile()
    path = folder / f"{name}.xml"
    path.write_text(spec.to_xml())
    return path


def part(name: str = "nao_h25") -> object:
    return description(name).part(ARM)


@cache
def skin(name: str = "nao_h25") -> object:
    """The skin as the robot's Skin port tells it."""
    found = SkinGeometry.of(description(name))
    return demo().recording.Skin(
        found.points,
        found.normals,
        found.limb,
        found.limbs,
        tuple(frame.body for frame in found.frames),
        np.array([frame.origin for frame in found.frames]),
        np.array([frame.axes for frame in found.frames]),
    )


def places(name: str = "nao_h25") -> tuple:
    make = demo().recording.Place
    fields = part(name).fields
    return tuple(make(f.name, f"{ARM}/{f.limb}", f.centre, f.radius) for f in fields)


def recording(force: float = 2.0, motion: float = 1.0, name: str = "NAO", **changes: object):
    """Touches of outer and under, 2 s apart; the arm goes by `motion` times the fields' motion."""
    r = demo().recording
    time = np.arange(0, 5, STEP)
    where, fields = skin(), {field.name: field for field in part().fields}
    felt = np.zeros((len(time), len(where.limb)))
    arm = np.tile(part().start, (len(time), 1))
    presses, answers = [], []
    for i, place in enumerate((places()[0], places()[2])):
        late = 2.0 * i
        away = np.linalg.norm(where.points - place.centre, axis=1)
        away[where.limb != where.limbs.index(place.limb)] = np.inf
        nearest = np.argsort(away)[:4]
        during = (time > FELT + late - 0.01) & (time < FREE + late - 0.01)
        felt[np.ix_(during, nearest)] = force / 4
        ramp = np.clip((time - (MOVED + late) + STEP) / 0.1, 0, 1) * (time < 2.9 + late)
        arm += motion * ramp[:, None] * fields[place.name].motion
        presses.append(r.Press(place.name, PRESSED + late, 2.0 + late))
        answers += [r.Answer(FELT + late, place.name, 0.9, force / 4),
                    r.Answer(FELT + late, "another", 0.1, force / 4)]  # fmt: skip
    options = {
        "robot": name,
        "part": ARM,
        "skin": where,
        "places": places(),
        "presses": tuple(presses),
        "answers": tuple(answers),
        "frame_time": time,
        "force": felt,
        "arm_time": time,
        "arm": arm,
        "finger_time": time,
        "finger": np.zeros((len(time), 3)),
        "rest": dict(ROBOTS["nao_h25"]().start),
    }
    return r.Recording(**options | changes)

"""The robots that ship with the project: their bodies, and their generic arms and skins.

In: a name. Out: `Robot` of links, or the tactile description, compared with that robot.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.hardware.robots.icub import icub_v2
from robocomp_dsl.hardware.robots.links import Robot
from robocomp_dsl.hardware.robots.nao import nao_h21, nao_h25
from robocomp_dsl.tactile.description import model
from robocomp_dsl.tactile.description.check import check_bodies, check_joints
from robocomp_dsl.tactile.description.located import UNITS
from robocomp_dsl.tactile.description.read import load_robot

ROBOTS: dict[str, Callable[[], Robot]] = {
    "nao_h21": nao_h21,
    "nao_h25": nao_h25,
    "icub_v2": icub_v2,
}
_DESCRIPTIONS = Path(__file__).parent / "descriptions"


def description(name: str) -> model.Robot:
    """Generic arms and skin of the robot `name`; `KeyError` for a name that is not here.

    Raises `DescriptionError` when the file does not fit the robot.
    """
    body = ROBOTS[name]()
    read = load_robot(_DESCRIPTIONS / f"{name}.yaml")
    compare(read, body)
    return read


def compare(read: model.Robot, body: Robot) -> None:
    """Pass when every joint and body of the description is the robot's own, limits included.

    Raises `DescriptionError` with every finding.
    """
    units = {s.joint: UNITS[s.unit] for part in read.parts for s in part.servos if s.joint}
    limits = {
        name: (joint.low / units.get(name, 1.0), joint.high / units.get(name, 1.0))
        for name, joint in body.joints.items()
    }
    check_joints(read, limits)
    check_bodies(read, frozenset(link.name for link in body.links))

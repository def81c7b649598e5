"""The robots that ship with the project: their bodies, and their generic arms and skins.

In: a name. Out: `RobotModel` of links, or the tactile description, checked against that robot.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.simulation.robots.icub import icub_v2
from robocomp_dsl.simulation.robots.links import RobotModel
from robocomp_dsl.simulation.robots.nao import nao_h21, nao_h25
from robocomp_dsl.tactile.description import model
from robocomp_dsl.tactile.description.check import RobotStructure, compare
from robocomp_dsl.tactile.description.read import load_robot

ROBOTS: dict[str, Callable[[], RobotModel]] = {
    "nao_h21": nao_h21,
    "nao_h25": nao_h25,
    "icub_v2": icub_v2,
}
_DESCRIPTIONS = Path(__file__).parent / "descriptions"


def description_file(name: str) -> Path:
    """The description of generic arms and skin of the robot `name`."""
    return _DESCRIPTIONS / f"{name}.yaml"


def description(name: str) -> model.RobotDescription:
    """Generic arms and skin of the robot `name`; raises `KeyError` for an unknown name.

    Raises `DescriptionError` when the file does not fit the robot.
    """
    body = ROBOTS[name]()
    read = load_robot(description_file(name))
    compare(read, facts(body))
    return read


def facts(body: RobotModel) -> RobotStructure:
    """The robot's data that a description is checked against."""
    joints = {name: (joint.low, joint.high) for name, joint in body.joints.items()}
    return RobotStructure(joints, frozenset(link.name for link in body.links))

"""`rcgen simulator --tactile`: the skin of a description on the bodies of a simulated world.

In: a simulator, and the path of a description in YAML. Out: the simulator with a skin; findings if
the description does not fit the world.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robocomp_dsl.check.codes import tactile as codes
from robocomp_dsl.check.innermodel import tactile
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.skin import lower_robot
from robocomp_dsl.generate.simulator.simulator import Simulator, with_skin
from robocomp_dsl.hardware.description.scene import JOINTS
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.tactile.description.check import RobotStructure


def with_described_skin(
    simulator_: Simulator, path: Path, workspace: Workspace, report: Report
) -> Simulator:
    """The simulator with the skin of the file, or unchanged after errors."""
    try:
        source = workspace.sources.read(path)
    except UnreadableSource as error:
        message = f"`{path}` cannot be used: {error}"
        report.add(codes.TACTILE_SYNTAX, Source(path, "").file_span, message)
        return simulator_
    robot = tactile.check_robot(source, report)
    if robot is None:
        return simulator_
    tactile.check_against_structure(robot, _facts(simulator_.scene), source, report)
    if not any(part.patches for part in robot.parts):
        report.add(codes.TACTILE_SYNTAX, source.file_span, "no part has a `skin`")
    return simulator_ if report.has_errors else with_skin(simulator_, lower_robot(robot))


def _facts(scene: dict[str, Any]) -> RobotStructure:
    """Joints with their limits [rad, m], and bodies."""
    joints = {d["id"]: _limits(d) for d in scene["devices"] if d["kind"] in JOINTS}
    bodies = (f["id"] for f in scene["frames"] if f.get("given", "body") == "body")
    return RobotStructure(joints, frozenset(bodies))


def _limits(device: dict[str, Any]) -> tuple[float, float]:
    """The limits of a joint [rad, m]; those of InnerModel slides are converted from mm."""
    settings = device["settings"]
    if "low" in settings or "high" in settings:
        return settings.get("low", -float("inf")), settings.get("high", float("inf"))
    unit = 0.001 if device["kind"] == "prismaticjoint" else 1.0
    return settings.get("min", -float("inf")) * unit, settings.get("max", float("inf")) * unit

"""`rcgen simulator --tactile`: the skin of a description on the bodies of a simulated world.

In: what is simulated, and the path of a description in YAML. Out: the same with a skin; findings
where the description does not fit the world.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robocomp_dsl.check import codes, tactile
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.simulator import Simulator, with_skin
from robocomp_dsl.generate.skin import lower_robot
from robocomp_dsl.hardware.scene import JOINTS
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.tactile.description.check import Facts


def touched(made: Simulator, path: Path, workspace: Workspace, report: Report) -> Simulator:
    """The simulator with the skin that the file describes, or as it was after errors."""
    try:
        source = workspace.files.read(path)
    except UnreadableSource as error:
        said = f"`{path}` cannot be used: {error}"
        report.add(codes.TACTILE_FORM, Source(path, "").whole, said)
        return made
    robot = tactile.judge_robot(source, report)
    if robot is None:
        return made
    tactile.judge_facts(robot, _facts(made.scene), source, report)
    if not any(part.patches for part in robot.parts):
        report.add(codes.TACTILE_FORM, source.whole, "no part of it has a `skin`")
    return made if report.failed else with_skin(made, lower_robot(robot))


def _facts(scene: dict[str, Any]) -> Facts:
    """Joints with their limits [rad, m], and bodies."""
    joints = {d["id"]: _limits(d) for d in scene["devices"] if d["kind"] in JOINTS}
    bodies = (f["id"] for f in scene["frames"] if f.get("given", "body") == "body")
    return Facts(joints, frozenset(bodies))


def _limits(device: dict[str, Any]) -> tuple[float, float]:
    """Of a joint of a model file as told there, of one in InnerModel from mm."""
    given = device["settings"]
    if "low" in given or "high" in given:
        return given.get("low", -float("inf")), given.get("high", float("inf"))
    unit = 0.001 if device["kind"] == "prismaticjoint" else 1.0
    return given.get("min", -float("inf")) * unit, given.get("max", float("inf")) * unit

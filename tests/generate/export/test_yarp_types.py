"""Thrift and Bottle definitions in the export formats."""

from __future__ import annotations

import json

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import export
from tests.generate.golden_cases import GOLDEN


def exported(target: str) -> dict[str, str]:
    report = Report()
    modules = check_idsl(GOLDEN / "thrift" / "Eyes.idsl", Workspace(environ={}), report)
    assert modules
    assert not report.has_errors
    files = {file.path: file.text for file in export(modules, target).files}
    assert files
    return files


def test_thrift_service_in_slice_has_inherited_operations() -> None:
    text = exported("slice")["motor.ice"]
    motor = text[text.index("interface Motor") :]
    assert "string get_version();" in motor
    assert "Status get_status();" in motor


def test_each_thrift_service_has_its_operations_in_ros2() -> None:
    services = {path.rpartition("/")[2] for path in exported("ros2") if path.endswith(".srv")}
    assert {"BaseGetVersion.srv", "MotorGetVersion.srv", "MotorMoveTo.srv"} <= services


def test_bottle_definition_in_json_schema() -> None:
    (text,) = exported("json-schema").values()
    definitions = json.loads(text)["$defs"]
    azimuth = definitions["gaze.gaze"]["properties"]["azimuth"]
    assert azimuth["description"] == "positive to the left [deg]"

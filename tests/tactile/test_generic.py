"""What is generic knows no robot, and what the interfaces say is what the code does."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import robocomp_dsl.tactile
from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.resources import INTERFACES

ROOT = Path(robocomp_dsl.tactile.__file__).parent
ROBOT_NAMES = re.compile(r"nao|icub|robocup", re.IGNORECASE)


@pytest.mark.parametrize("package", ["arm", "reflex", "description"])
def test_generic_modules_name_no_robot(package):
    files = sorted((ROOT / package).glob("*.py"))
    assert files
    for file in files:
        assert not ROBOT_NAMES.search(file.read_text(encoding="utf-8")), file.name


@pytest.mark.parametrize("name", ["Skin", "GenericArm", "Reflex", "ControlBoard"])
def test_touch_interfaces_have_no_findings(name):
    report = Report()
    check_file(INTERFACES / f"{name}.idsl", Workspace(environ={}), report)
    assert [finding.message for finding in report] == []


def values(file: str, enum: str) -> list[str]:
    """The enumerators of one enumeration, in capitals with underscores."""
    text = (INTERFACES / file).read_text(encoding="utf-8")
    listed = re.search(rf"enum {enum}\s*{{([^}}]*)}}", text)
    assert listed
    words = [word.strip() for word in listed[1].split(",")]
    return [re.sub(r"(?<=[a-z])(?=[A-Z])", "_", word).upper() for word in words]


def test_touch_interface_enumerations_match_code():
    renamed = {"HARDWARE_FAULT": "HW_FAULT", "CALIBRATION_DONE": "CALIB_DONE"}
    modes = [renamed.get(value, value) for value in values("ControlBoard.idsl", "ControlMode")]
    assert modes == [mode.name for mode in Mode]
    assert values("ControlBoard.idsl", "InteractionMode") == [mode.name for mode in Interaction]

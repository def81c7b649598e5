"""`rcgen bridge X.ini`: what yarp-bottle-generator accepts silently ends with a located finding."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen
from tests.migrate.bottle_generator.configurations import TO_ROS, TO_YARP, replaced
from tests.migrate.bottle_generator.test_rejected import REJECTED

TYPE = "/gripper_target=geometry_msgs/Point"
NESTED = {"contains itself": "msg", "mux in nested for YARP": "mux"}


def broken(name: str) -> tuple[str, str]:
    """A configuration with one fault, and what the finding says."""
    text, change, message = REJECTED[name]
    changes = [change]
    if name in NESTED:
        changes.insert(0, ("2_type = list", f"2_type = {NESTED[name]}"))
    changes = [
        (old, new.replace("lab_msgs/Shape", "geometry_msgs/Vector3")) for old, new in changes
    ]
    return replaced(text, *changes), message


@pytest.mark.parametrize("name", REJECTED)
def test_bridge_rejects_configuration(rcgen: Rcgen, here: Path, name: str) -> None:
    text, message = broken(name)
    (here / "lab.ini").write_text(text)
    run = rcgen("bridge", "lab.ini", "--type", TYPE, "--format", "concise")
    assert run.code == 1
    assert run.out == ""
    located = [line for line in run.err.splitlines() if re.match(r"lab\.ini:\d+:\d+: error", line)]
    assert any(message in line for line in located), run.err
    assert [path.name for path in here.iterdir()] == ["lab.ini"]


@pytest.mark.parametrize("text", [TO_ROS, TO_YARP])
def test_bridge_accepts_configuration(rcgen: Rcgen, here: Path, text: str) -> None:
    (here / "lab.ini").write_text(text)
    run = rcgen("bridge", "lab.ini", "--type", TYPE, "--dry-run")
    assert run.code == 0, run.err


def test_bridge_is_named_after_file_without_a_second_argument(rcgen: Rcgen, here: Path) -> None:
    (here / "lab.ini").write_text(TO_ROS)
    run = rcgen("bridge", "lab.ini", "lab")
    assert run.code == 2
    assert "lab" in run.err
    assert [path.name for path in here.iterdir()] == ["lab.ini"]

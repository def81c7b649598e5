"""`load_arm_part`: the part that a component's parameters name, or all findings at their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.tactile.description.part_file import load_arm_part
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError

TEXT = """\
robot: one_arm
parts:
  left_arm:
    servos: 3
"""


def test_load_arm_part_shows_lines_and_carets_of_a_wrong_description(tmp_path: Path) -> None:
    file = tmp_path / "r.yaml"
    file.write_text(TEXT, encoding="utf-8")
    with pytest.raises(DescriptionError) as described:
        read_robot(TEXT, file)
    with pytest.raises(ConfigError) as refused:
        load_arm_part(str(file), "left_arm", None)
    assert refused.value.findings == described.value.findings
    assert f"  --> {file}:4:13\n   |\n 4 |     servos: 3\n   |             ^" in str(refused.value)


def test_load_arm_part_without_the_file(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="not found"):
        load_arm_part(str(tmp_path / "gone.yaml"), "left_arm", None)

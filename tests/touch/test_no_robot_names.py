"""The components of touch know no robot: none of their files names one, nor a joint of one."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.simulation.robots.catalog import ROBOTS
from tests.touch.shipped_component import COMPONENTS

SHARED = ("generic_arm", "reflex")
MAKERS = ("nao", "icub", "pepper", "aldebaran", "softbank", "robotology", "roboskin")
JOINTS = sorted({joint for make in ROBOTS.values() for joint in make().joints})
NAMED = re.compile(
    rf"(?<![a-z])({'|'.join(MAKERS)})(?![a-z])|\b({'|'.join(map(re.escape, JOINTS))})\b",
    re.IGNORECASE,
)
MADE_BY_TOOLS = {"__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache"}


def files(component: str) -> list[Path]:
    every = (COMPONENTS / component).rglob("*")
    return [path for path in every if path.is_file() and not MADE_BY_TOOLS & set(path.parts)]


def test_robot_name_search_finds_names() -> None:
    for text in ("a NAO here", "nao_h25.yaml", "iCub's", "LShoulderPitch", "joint: l_elbow,"):
        assert NAMED.search(text), text
    for text in ("naomi", "shoulder_pitch", "an elbow", "left_arm"):
        assert not NAMED.search(text), text


@pytest.mark.parametrize("component", SHARED)
def test_touch_files_name_no_robot(component: str) -> None:
    found = files(component)
    assert {f"{component}.cdsl", "specificworker.py", "README.md", "config.yaml"} <= {
        path.name for path in found
    }
    named = [
        f"{path.relative_to(COMPONENTS)}:{number}: {match[0]}"
        for path in found
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if (match := NAMED.search(line))
    ]
    assert named == []

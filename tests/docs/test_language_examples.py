"""Every example in the reference of the languages parses without a finding."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.languages import check_file, check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from tests.docs.blocks import ROOT, Block, blocks

REFERENCE = ROOT / "docs" / "reference"
LANGUAGES = {"idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl", "innermodel"}
EXAMPLES = [
    block
    for name in sorted(LANGUAGES)
    for block in blocks(REFERENCE / f"{name}.md")
    if block.language in LANGUAGES | {"xml"}
]


def _suffix(block: Block) -> str:
    if block.language != "xml":
        return f".{block.language}"
    return ".scxml" if block.text.startswith("<scxml") else ".xml"


@pytest.mark.parametrize("block", EXAMPLES, ids=lambda block: f"{block.page.stem}:{block.line}")
def test_example_parses_without_a_finding(block: Block, tmp_path: Path) -> None:
    path = tmp_path / f"example{_suffix(block)}"
    path.write_text(block.text, encoding="utf-8")
    report = Report()
    check_syntax(path, Workspace(environ={}), report)
    assert [finding.message for finding in report] == []


@pytest.mark.parametrize(
    "block",
    [block for block in EXAMPLES if block.language == "bdsl"],
    ids=lambda block: f"{block.page.stem}:{block.line}",
)
def test_bridge_example_is_valid(block: Block, tmp_path: Path) -> None:
    pytest.importorskip("rosbags", reason="ROS definitions come from rosbags")
    (tmp_path / "RoboCompMotors.idsl").write_text(
        "module RoboCompMotors { interface Motors { bool setPower(bool on); }; };"
    )
    actions = tmp_path / "my_msgs" / "action"
    actions.mkdir(parents=True)
    width = "float64 width  # [m]\n"
    (actions / "Grasp.action").write_text(f"{width}---\n{width}---\n{width}")
    path = tmp_path / "example.bdsl"
    path.write_text(block.text, encoding="utf-8")
    report = Report()
    check_file(path, Workspace(environ={}), report)
    assert [finding.message for finding in report] == []


def test_every_language_has_an_example() -> None:
    suffixes = {_suffix(block) for block in EXAMPLES}
    assert suffixes == {".idsl", ".cdsl", ".pdsl", ".ddsl", ".smdsl", ".bdsl", ".scxml", ".xml"}

"""`rcgen breaking`: deployments that a change breaks."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

FILES = {
    "idsl/Drive.idsl": "module M { struct Speed { float adv; };\n"
    "interface Drive { void set(Speed s); }; interface State { void now(Speed s); }; };\n",
    "base/base.cdsl": 'import "Drive.idsl";\nComponent base\n{\n'
    "    Communications { implements Drive; publishes State; };\n"
    '    language Python; parameters "base.pdsl"; statemachine "base.smdsl";\n};\n',
    "base/base.pdsl": "ComponentParams base\n{\n    speed float 100 [mm] 0:1000;\n"
    '    serial string "a";\n    mode {slow, fast} slow;\n};\n',
    "base/base.smdsl": "base\n{\n    initial_state on;\n    end_state off;\n"
    "    transitions { on => off on x; };\n};\n",
    "nav/nav.cdsl": 'import "Drive.idsl";\nComponent nav\n{\n'
    "    Communications { requires Drive; subscribesTo State; };\n    language Python;\n};\n",
    "robot.ddsl": 'import "base/base.cdsl";\nimport "nav/nav.cdsl";\nDeployment robot\n{\n'
    '    component base { set speed = 800; set serial = "b"; config "base.yaml"; };\n'
    "    component nav;\n    connect nav.Drive -> base.Drive;\n};\n",
    "base.yaml": "speed: 900\nmode: fast\n",
}

# File, old text, new text, and the finding of the deployment: code, location, words.
CASES = [
    ("base/base.pdsl", "0:1000", "0:2000", []),
    ("base/base.pdsl", "0:1000", "0:850", []),  # the deployment overrides what its file says
    ("base/base.pdsl", "0:1000", "0:500", [
        ("RC646", "base.yaml:1:8", "`speed` is 900 mm, its highest value is 500 mm (`base`)"),
        ("RC646", "robot.ddsl:5:34", "`speed` cannot be set to this: 800 is not within 0 to 500"),
    ]),
    ("base/base.pdsl", '    serial string "a";\n', "",
     [("RC646", "robot.ddsl:5:43", "`base` has no parameter `serial`")]),
    ("base/base.pdsl", 'string "a"', "int 1",
     [("RC646", "robot.ddsl:5:52", "`serial` cannot be set to this")]),
    ("base/base.pdsl", "{slow, fast}", "{slow}",
     [("RC646", "base.yaml:2:7", "`mode` cannot be `fast`")]),
    ("base/base.pdsl", "speed float", "more int; speed float",
     [("RC646", "base.yaml:1:1", "`more`")]),
    ("base/base.cdsl", "implements Drive; ", "", [("RC645", "robot.ddsl:7:31", "no port `Drive`")]),
    ("base/base.cdsl", "implements Drive", "implements Drive as front",
     [("RC645", "robot.ddsl:7:31", "`base` has no port `Drive`")]),
    ("base/base.cdsl", "publishes State; ", "",
     [("RC645", "robot.ddsl:6:15", "`nav` subscribes to `State`, but no component publishes it")]),
    ("nav/nav.cdsl", "requires Drive", "requires Drive, Drive as second", []),
    ("nav/nav.cdsl", "requires Drive", "requires State, Drive",
     [("RC645", "robot.ddsl:6:15",
       "`nav` requires `State`, but no component of this deployment implements it")]),
]  # fmt: skip


def git(folder: Path, *arguments: str) -> None:
    who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *who, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def robot(here: Path) -> Path:
    """A committed tree: two components and a deployment of them."""
    for name, text in FILES.items():
        (here / name).parent.mkdir(exist_ok=True)
        (here / name).write_text(text)
    git(here, "init", "-q")
    git(here, "add", ".")
    git(here, "commit", "-qm", "first")
    return here


def change(folder: Path, name: str, old: str, new: str) -> None:
    text = (folder / name).read_text()
    assert old in text
    (folder / name).write_text(text.replace(old, new))


def report_of(rcgen: Rcgen, *more: str) -> list[tuple[str, str, str]]:
    run = rcgen("breaking", "--against", "HEAD", "-I", "idsl", "--format", "json", *more)
    assert run.err == "", "the earlier version was understood"
    return [
        (
            load["code"],
            f"{os.path.relpath(load['file'])}:{load['line']}:{load['column']}",
            load["message"],
        )
        for load in json.loads(run.out)
    ]


@pytest.mark.parametrize(("name", "old", "new", "expected"), CASES)
def test_breaking_reports_broken_deployment(
    rcgen: Rcgen, robot: Path, name: str, old: str, new: str, expected: list[tuple[str, str, str]]
) -> None:
    assert report_of(rcgen) == []
    change(robot, name, old, new)
    found = [item for item in report_of(rcgen) if item[0] in ("RC645", "RC646")]
    assert [item[:2] for item in found] == [item[:2] for item in expected]
    for (_, _, message), (_, _, words) in zip(found, expected, strict=True):
        assert message.startswith("deployment `robot`: ")
        assert words in message


def test_breaking_reports_removed_component_of_deployment(rcgen: Rcgen, robot: Path) -> None:
    (robot / "base" / "base.cdsl").unlink()
    found = {place: code for code, place, _ in report_of(rcgen) if place.startswith("robot.ddsl")}
    assert found["robot.ddsl:1:8"] == "RC645"


def test_breaking_ignores_deployment_updated_with_components(rcgen: Rcgen, robot: Path) -> None:
    change(robot, "base/base.pdsl", '    serial string "a";\n', "")
    change(robot, "robot.ddsl", 'set serial = "b"; ', "")
    assert [code for code, _, _ in report_of(rcgen)] == ["RC643"]


def test_breaking_reports_errors_of_deployment_first(rcgen: Rcgen, robot: Path) -> None:
    change(robot, "robot.ddsl", "set speed", "set spede")
    run = rcgen("breaking", "--against", "HEAD", "-I", "idsl")
    assert (run.code, run.out) == (1, ". against HEAD: no findings\n")
    assert "did you mean `speed`?" in run.err
    assert "files has errors and is not compared: `robot.ddsl`" in run.err


def test_breaking_notes_affected_connections(rcgen: Rcgen, robot: Path) -> None:
    change(robot, "idsl/Drive.idsl", "float adv", "double adv")
    out = rcgen("breaking", "--against", "HEAD", "-I", "idsl").out
    message = "note: deployment `robot` connects `nav.Drive` to `base.Drive` with it: restart both"
    assert f"{message}\n  --> robot.ddsl:7:5" in out
    assert "connects `base.State` to `nav.State` with it" in out


def test_breaking_of_single_deployment_file(rcgen: Rcgen, robot: Path) -> None:
    change(robot, "base/base.cdsl", "implements Drive; ", "")
    found = report_of(rcgen, "robot.ddsl")
    assert [item[0] for item in found] == ["RC645"]
    run = rcgen("breaking", "base.yaml", "--against", "HEAD")
    assert (run.code, "is none of the files" in run.err) == (1, True)

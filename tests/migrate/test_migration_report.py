"""`MIGRATION.md`: a short summary first, paths with one base, next steps that work."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.migrate.worlds import HEAD, write_component

Rcgen = Callable[..., object]


def test_report_begins_with_ten_lines_of_summary(rcgen, old: Path, tmp_path: Path) -> None:
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    rcgen("migrate", old / "robot.xml", *folders, "-o", tmp_path / "new")
    lines = (tmp_path / "new/MIGRATION.md").read_text().splitlines()
    assert lines[:2] == ["# Migration of robot", ""]
    summary = lines[2 : lines.index("", 2)]
    assert len(summary) <= 10
    assert "- `follow`: its worker was carried over" in summary
    assert lines[lines.index("", 2) + 1] == "## Next"


def test_report_summary_names_first_error(rcgen, tmp_path: Path) -> None:
    worker = f"import nowhere_at_all\n{HEAD}    def compute(self):\n        pass\n"
    folder = write_component(tmp_path / "eyes", {"src/specificworker.py": worker})
    rcgen("migrate", folder)
    text = (tmp_path / "eyes-migrated/MIGRATION.md").read_text()
    head, _, rest = text.partition("## Next")
    assert "- first: `../eyes/src/specificworker.py:1` `nowhere_at_all` is not installed" in head
    assert rest.split()[:3] == ["pip", "install", "nowhere_at_all"]


def test_report_paths_are_relative_to_it(rcgen, old: Path, tmp_path: Path) -> None:
    out = tmp_path / "new"
    rcgen("migrate", old / "follow", "-o", out)
    text = (out / "MIGRATION.md").read_text()
    listed = re.findall(
        r"^- `([^`]+?)(?::\d+)?` \S", text.partition("## How the old")[0], re.MULTILINE
    )
    listed += re.findall(r"^\| `([^`(*]+)` \|", text, re.MULTILINE)
    assert len(listed) > 20
    assert [path for path in listed if not (out / path).exists()] == []


def test_report_lists_generated_files_in_one_line(rcgen, tmp_path: Path) -> None:
    names = ("genericworker.cpp", "genericworker.h", "main.cpp", "commonbehaviorI.cpp")
    files = {f"src/{name}": "// code\n" for name in names}
    rcgen("migrate", write_component(tmp_path / "eyes", files))
    text = (tmp_path / "eyes-migrated/MIGRATION.md").read_text()
    rows = [row for row in text.splitlines() if "genericworker.cpp" in row]
    assert len(rows) == 1
    assert all(f"`../eyes/src/{name}`" in rows[0] for name in names)


def test_report_next_steps_work(
    rcgen, old: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "new"
    rcgen("migrate", old / "robot.xml", old / "follow", "-o", out)
    text = (out / "MIGRATION.md").read_text()
    steps = [line.strip() for line in text.splitlines() if line.startswith("    ")]
    monkeypatch.chdir(out)
    for step in steps:
        words = shlex.split(step.partition("#")[0])
        if words[0] == "rcgen":
            assert rcgen(*words[1:]).code == 0, step
        elif words[0] == "for":
            for peer in sorted(Path().glob("peers/*/*.cdsl")):
                assert rcgen("component", peer).code == 0, step
    assert [step.split()[0] for step in steps] == ["rcgen", "(cd", "for", "rcdeploy", "rcdeploy"]
    assert rcgen("check", ".").code == 0
    assert all((path.parent / "main.py").is_file() for path in Path().glob("*/*/*.cdsl"))

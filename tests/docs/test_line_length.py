"""No line of a Markdown file is longer than 120 characters, so that diffs and terminals show it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.docs.blocks import ROOT

LIMIT = 120
SHOWN_ELSEWHERE = ("tests/", "templates/", ".rcgen/")
"""Inputs and expected output of tests, templates with their tags, and copies of generated files."""
GENERATED = ("tests/golden/*/expected/README.md", "components/*/.rcgen/pristine/README.md")


def _files() -> list[Path]:
    tracked = subprocess.run(
        ["git", "ls-files", "-z", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True
    )
    names = [name for name in tracked.stdout.split("\0") if name]
    written = [n for n in names if not n.startswith(SHOWN_ELSEWHERE) and "/.rcgen/" not in n]
    return [ROOT / name for name in written]


@pytest.mark.parametrize("path", _files(), ids=lambda path: str(path.relative_to(ROOT)))
def test_lines_of_a_markdown_file_are_short(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    assert [(i, len(line)) for i, line in enumerate(lines, 1) if len(line) > LIMIT] == []


@pytest.mark.parametrize(
    "path",
    sorted(path for pattern in GENERATED for path in ROOT.glob(pattern)),
    ids=lambda path: str(path.relative_to(ROOT)),
)
def test_lines_of_a_generated_readme_are_short(path: Path) -> None:
    """Rows of tables cannot be broken."""
    lines = enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
    text = [(i, line) for i, line in lines if not line.startswith("|")]
    assert text
    assert [(i, len(line)) for i, line in text if len(line) > LIMIT] == []

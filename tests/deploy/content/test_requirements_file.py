"""The requirements of a component: lines of packages, findings at everything else."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.deploy.content.requirements_file import read_requirements
from robocomp_dsl.diagnostics import Report
from tests.deploy.content.workspace_files import write_files


def read(folder: Path, content: str | bytes) -> tuple[list[tuple[str, int]], list[tuple[int, str]]]:
    """Requirements with lines, and findings with lines."""
    write_files(folder, {"requirements.txt": content})
    report = Report()
    found = [(str(requirement), line) for requirement, line in read_requirements(folder, report)]
    return found, [(f.span.start_position[0], f.message) for f in report]


def test_requirements_file_lists_packages(tmp_path: Path) -> None:
    text = "# drivers\nnumpy>=1.26  # arrays\n\npyserial[cp2110]==3.5; python_version > '3.9'\n"
    found, findings = read(tmp_path, text)
    assert [line for _, line in found] == [2, 4]
    assert found[0][0] == "numpy>=1.26"
    assert not findings


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("-r other.txt", "an option"),
        ("--index-url https://example.org", "an option"),
        ("./local", "not a requirement"),
        ("numpy>>3", "not a requirement"),
        ("https://example.org/x.whl", "not a requirement"),
    ],
)
def test_requirements_file_refuses_other_lines(tmp_path: Path, line: str, what: str) -> None:
    found, findings = read(tmp_path, f"numpy\n  {line}\nPyYAML\n")
    assert [name for name, _ in found] == ["numpy", "PyYAML"]
    ((number, message),) = findings
    assert number == 2
    assert message.startswith(f"`{line}` is {what}")


def test_requirements_file_reports_unreadable_text(tmp_path: Path) -> None:
    found, findings = read(tmp_path, b"\xff\xfe\x00\x81")
    assert not found
    assert len(findings) == 1

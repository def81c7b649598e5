"""Findings about Python 2 workers name the lines of the old file."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import worker_codes
from robocomp_dsl.migrate.original_lines import ConvertedSource, locate_in_originals
from robocomp_dsl.source import Source
from tests.migrate.worlds import HEAD, write_component

OLD = "import sys\nx = a / b\nprint x\n"
NEW = "from helpers import divide\nimport sys\nx = divide(a, b)\nprint(x)\n"


def located(new: str, old: str, line: int) -> tuple[int, str]:
    """The line and the text of a finding about the line of the new text."""
    report, path = Report(), Path("worker.py")
    original = Source(path, old)
    source = ConvertedSource(path, new, original=original)
    report.add(worker_codes.DIFFERENT_PROCESS, source.span_at(line), "differs")
    locate_in_originals(report)
    (found,) = report
    assert found.span.source is original
    return found.span.start_position[0], found.span.text


@pytest.mark.parametrize(
    ("line", "expected"),
    [(1, (1, "import sys")), (2, (1, "import sys")), (3, (2, "x = a / b")), (4, (3, "print x"))],
)
def test_locate_in_originals_finds_the_line_of_the_old_text(
    line: int, expected: tuple[int, str]
) -> None:
    assert located(NEW, OLD, line) == expected


def test_locate_in_originals_of_texts_of_other_lengths() -> None:
    assert located("a\nb\nc\n", "", 3) == (1, "")
    assert located("", "a\nb\n", 1)[0] == 1
    assert located("a\nb = 1\nc = 2\nd\n", "a\nb = 1; c = 2\nd\n", 3) == (2, "b = 1; c = 2")
    assert located("a\nb\nx", "a\nb\n", 3)[0] == 2


def test_locate_in_originals_keeps_other_findings_and_columns() -> None:
    report, path = Report(), Path("worker.py")
    other = Source(Path("c.cdsl"), "abc")
    source = ConvertedSource(path, NEW, original=Source(path, OLD))
    at = NEW.index("sys")
    report.add(worker_codes.DIFFERENT_PROCESS, source.span(at, at + 3), "a")
    report.add(worker_codes.DIFFERENT_PROCESS, other.span(1, 2), "b")
    locate_in_originals(report)
    assert [(d.span.source.text, d.span.start, d.span.text) for d in report] == [
        (OLD, 7, "sys"),
        ("abc", 1, "b"),
    ]


def test_migrate_names_lines_of_python_2_workers(rcgen, tmp_path: Path) -> None:
    worker = HEAD.replace("PySide2.QtCore import QTimer", "PySide import QtCore") + (
        "    def compute(self):\n        print self.a / self.b\n        print cmp(self.a, self.b)\n"
    )
    folder = write_component(tmp_path / "eyes", {"src/specificworker.py": worker})
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 1
    line = next(n for n, text in enumerate(worker.splitlines(), 1) if "cmp" in text)
    assert f"eyes/src/specificworker.py:{line}:9: error[RC899]: `cmp` does not exist" in done.err

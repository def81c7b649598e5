"""Common mistakes and their findings, in `mistakes/*.txt`.

An entry is a text, a line `---`, and a line for every finding: place, code, message, label, help,
and what the fix makes of the text that it changes.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import LANGUAGES, parse_innermodel

FOLDER = Path(__file__).with_name("mistakes")
PARSERS = {**LANGUAGES, ".xml": parse_innermodel}


def render(suffix: str, text: str) -> str:
    report = Report()
    tree = PARSERS[suffix](Source(Path(f"example{suffix}"), text), report)
    assert tree is not None
    return "".join(map(line, report.sorted())) or "nothing\n"


def line(diagnostic: Diagnostic) -> str:
    (row, column), (_, until) = diagnostic.span.start_position, diagnostic.span.end_position
    fixes = (
        (f"{edit.span.text!r} → {edit.text!r}" for edit in diagnostic.fix.edits)
        if diagnostic.fix
        else ()
    )
    parts = (diagnostic.message, diagnostic.label, diagnostic.help, ", ".join(fixes))
    detail = " | ".join(part for part in parts if part)
    return f"{row}:{column}-{until} {diagnostic.code.id} {detail}\n"


@pytest.mark.parametrize("suffix", sorted(PARSERS))
def test_parser_reports_common_mistakes(suffix: str, update_golden: bool) -> None:
    path = FOLDER / f"{suffix[1:]}.txt"
    expected = path.read_text(encoding="utf-8")
    texts = [entry.partition("---\n")[0] for entry in expected.split("===\n")]
    assert len(texts) >= 6
    actual = "===\n".join(f"{text}---\n{render(suffix, text)}" for text in texts)
    if update_golden:
        path.write_text(actual, encoding="utf-8")
    assert actual == expected or update_golden

"""The mistakes that people make: what is written, and what is said of it, in `mistakes/*.txt`.

An entry is a text, a line `---`, and a line for every finding: place, code, message, label, help,
and what the fix makes of the text that it changes.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import LANGUAGES, parse_innermodel

FOLDER = Path(__file__).with_name("mistakes")
PARSERS = {**LANGUAGES, ".xml": parse_innermodel}


def said(suffix: str, text: str) -> str:
    report = Report()
    tree = PARSERS[suffix](Source(Path(f"example{suffix}"), text), report)
    assert tree is not None
    return "".join(map(line, report.sorted())) or "nothing\n"


def line(one: Diagnostic) -> str:
    (row, column), (_, until) = one.span.begin, one.span.finish
    fixes = (f"{edit.span.text!r} → {edit.text!r}" for edit in one.fix.edits) if one.fix else ()
    parts = (one.message, one.label, one.help, ", ".join(fixes))
    return f"{row}:{column}-{until} {one.code.id} {' | '.join(part for part in parts if part)}\n"


@pytest.mark.parametrize("suffix", sorted(PARSERS))
def test_mistakes(suffix: str, update_golden: bool) -> None:
    path = FOLDER / f"{suffix[1:]}.txt"
    kept = path.read_text(encoding="utf-8")
    texts = [entry.partition("---\n")[0] for entry in kept.split("===\n")]
    assert len(texts) >= 6
    made = "===\n".join(f"{text}---\n{said(suffix, text)}" for text in texts)
    if update_golden:
        path.write_text(made, encoding="utf-8")
    assert made == kept or update_golden

"""`--limit-findings`: text output shows the first findings, JSON shows all."""

from __future__ import annotations

import json
from pathlib import Path

from robocomp_dsl.cli.output.limit import MAX_FINDINGS
from tests.cli.rcgen_run import Rcgen


def _text(count: int) -> str:
    # The legacy form in front is a warning: errors win where not all are listed.
    fields = "".join(f"  Typo{number} f{number};\n" for number in range(count))
    return f"module M {{\n  struct S {{\n    int a;;\n{fields}  }};\n}};\n"


def test_limit_findings_lists_first_findings_for_people(rcgen: Rcgen, here: Path) -> None:
    (here / "a.idsl").write_text(_text(3000))
    (here / "b.idsl").write_text(_text(1))
    run = rcgen("check", ".", "--format", "concise")
    lines = run.out.splitlines()
    assert sum(line.startswith("a.idsl:") for line in lines) == MAX_FINDINGS
    assert all("error[" in line for line in lines if line.startswith("a.idsl:"))
    assert sum(line.startswith("b.idsl:") for line in lines) == 2
    assert run.err == (
        f"a.idsl: {3001 - MAX_FINDINGS} further findings are not listed; --format json lists all\n"
    )
    summary = rcgen("check", "a.idsl").err.splitlines()[-1]
    assert summary == "1 file checked: 3000 errors, 1 warning"


def test_limit_findings_keeps_all_for_json(rcgen: Rcgen, here: Path) -> None:
    (here / "a.idsl").write_text(_text(300))
    found = json.loads(rcgen("check", "a.idsl", "--format", "json").out)
    assert len(found) == 301
    assert len(rcgen("check", "a.idsl", "--format", "github").out.splitlines()) == 301

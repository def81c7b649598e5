"""`rcgen check --fix`: legacy syntax is replaced, everything else is kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.fixes import is_safe
from robocomp_dsl.check.languages import check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import LANGUAGES
from tests.cli.rcgen_run import Rcgen

CASES = Path(__file__).parent.parent / "cases"
FORMS = {
    "a.cdsl": "Component a\n{\n    language Python;;\n    useQt qt4; // why\n};\n",
    "b.cdsl": "# old\nComponent a { Communications { requires ; }; language Python; };\n",
    "c.idsl": "module M\n{\n    struct S { int a; ; };\n    interface I { void f(); };\n};;\n",
    "d.idsl": "module M { enum E { a, b, }; interface I { int f(out int b, int a); }; };\n",
    "e.smdsl": "M { states a, b; initial_state a; transition { a => b; }; };\n",
}


def _automatic(path: Path) -> list[str]:
    report = Report()
    workspace = Workspace(environ={})
    check_syntax(path, workspace, report)
    source = workspace.sources.read(path)
    return [finding.message for finding in report if is_safe(finding, source)]


@pytest.mark.parametrize("name", FORMS)
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["lf", "crlf"])
def test_fix_replaces_legacy_syntax(rcgen: Rcgen, here: Path, name: str, end: str) -> None:
    path = here / name
    path.write_bytes(FORMS[name].replace("\n", end).encode())
    assert _automatic(path)
    run = rcgen("check", "--syntax", "--fix", name)
    assert run.err.startswith(f"{name}: fixed ")
    assert _automatic(path) == []
    assert path.read_bytes().count(b"\r\n") == path.read_bytes().count(b"\n") * (end == "\r\n")


def _shipped_cases() -> list[Path]:
    found = (p for p in CASES.rglob("*") if p.is_file() and p.suffix in LANGUAGES)
    return sorted(p for p in found if p.name != "Latin1.idsl")  # which is no text


@pytest.mark.parametrize("case", _shipped_cases(), ids=lambda p: str(p.relative_to(CASES)))
def test_fix_keeps_meaning(rcgen: Rcgen, here: Path, case: Path) -> None:
    copy = here / case.name
    copy.write_bytes(case.read_bytes())
    parse, before, after = LANGUAGES[case.suffix], Report(), Report()
    old = parse(Source.read(copy), before)
    rcgen("check", "--syntax", "--fix", copy.name)
    new = parse(Source.read(copy), after)
    assert repr(new) == repr(old)  # a tree without its spans
    assert _errors(after) == _errors(before)
    assert _automatic(copy) == []


def _errors(report: Report) -> list[str]:
    return [finding.message for finding in report if finding.severity is Severity.ERROR]


def test_fix_keeps_type_hash(rcgen: Rcgen, here: Path) -> None:
    text = "module M\n{\n    exception X { int a; };\n    interface I { %s };\n};\n"
    (here / "a.idsl").write_text(text % "[command] void run() throws X;")
    run = rcgen("check", "--fix", "a.idsl")
    assert "RC320" in run.out
    assert (here / "a.idsl").read_text() == text % "[command] void run() throws X;"


def test_fix_removes_empty_lines_and_keeps_comments(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(
        "Component a\n{\n    // first\n    useQt qt4;\n    language Python; // last\n};\n"
    )
    rcgen("check", "--fix", "a.cdsl")
    assert (here / "a.cdsl").read_text() == (
        "Component a\n{\n    // first\n    language Python; // last\n};\n"
    )


def test_fix_diff_writes_nothing(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(FORMS["a.cdsl"])
    run = rcgen("check", "--fix", "--diff", "a.cdsl")
    assert run.code == 0
    assert "-    language Python;;\n" in run.out
    assert "+    language Python;\n" in run.out
    assert (here / "a.cdsl").read_text() == FORMS["a.cdsl"]


def test_fix_keeps_errors(rcgen: Rcgen, here: Path) -> None:
    text = "Component a { Communications { requires Lasr; }; language Python; };\n"
    (here / "a.cdsl").write_text(text)
    run = rcgen("check", "--fix", "a.cdsl")
    assert run.code == 1
    assert "Lasr" in run.out
    assert (here / "a.cdsl").read_text() == text


@pytest.mark.parametrize("wrong", ["[Laser]", '"a-b"'])
def test_fix_keeps_code_with_errors(rcgen: Rcgen, here: Path, wrong: str) -> None:
    """`requires` lists nothing then; the fix for that alone would delete it."""
    path = here / "robot.cdsl"
    text = f"Component c {{ Communications {{ requires {wrong}; }}; language Python; }};\n"
    path.write_text(text)
    run = rcgen("check", "--fix", "--syntax", "robot.cdsl")
    assert run.code == 1
    assert path.read_text() == text


def test_fix_keeps_byte_order_mark_and_link(rcgen: Rcgen, here: Path) -> None:
    (here / "real.cdsl").write_bytes(b"\xef\xbb\xbf" + FORMS["a.cdsl"].encode())
    (here / "a.cdsl").symlink_to("real.cdsl")
    rcgen("check", "--fix", "a.cdsl")
    assert (here / "a.cdsl").is_symlink()
    assert (here / "real.cdsl").read_bytes().startswith(b"\xef\xbb\xbfComponent")
    assert ";;" not in (here / "real.cdsl").read_text()


def test_fix_usage_errors(rcgen: Rcgen, here: Path) -> None:
    assert rcgen("check", "--diff", "a.cdsl").code == 2
    assert rcgen("check", "--fix", "lost.cdsl").code == 1

"""`rcgen check`: files, formats and exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

GOOD = (
    'import "Laser.idsl";\nComponent a { Communications { requires Laser; }; language Python; };\n'
)
BAD = GOOD.replace("requires Laser", "requires Lasr")
LEGACY = GOOD.replace("language Python;", "language Python; useQt qt4;")


def test_check_of_valid_files(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    run = rcgen("check", "a.cdsl")
    assert (run.code, run.out) == (0, "")
    assert run.err == "1 file checked: no findings\n"


def test_check_shows_error_with_excerpt(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(BAD)
    run = rcgen("check", "a.cdsl")
    assert run.code == 1
    assert "interface `Lasr` is not declared by any import" in run.out
    assert "  --> a.cdsl:2:41\n" in run.out
    assert "^^^^ did you mean `Laser`?" in run.out
    assert run.err == "1 file checked: 1 error\n"


def test_check_succeeds_with_warnings(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(LEGACY)
    run = rcgen("check", "a.cdsl")
    assert run.code == 0
    assert "warning[" in run.out


def test_check_json_is_one_list(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(BAD)
    (here / "b.cdsl").write_text(BAD)
    run = rcgen("check", "a.cdsl", "b.cdsl", "--format", "json")
    assert run.code == 1
    assert run.err == ""
    found = json.loads(run.out)
    assert [item["file"] for item in found] == ["a.cdsl", "b.cdsl"]
    for item in found:
        assert item == {
            "code": item["code"],
            "severity": "error",
            "message": "interface `Lasr` is not declared by any import",
            "file": item["file"],
            "line": 2,
            "column": 41,
            "end_line": 2,
            "end_column": 45,
        }


def test_check_json_without_findings_is_empty_list(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    assert json.loads(rcgen("check", "a.cdsl", "--format", "json").out) == []


def test_check_concise_and_github_formats(rcgen: Rcgen, here: Path) -> None:
    (here / "a,b.cdsl").write_text(BAD)
    concise = rcgen("check", "a,b.cdsl", "--format", "concise").out
    assert concise.startswith("a,b.cdsl:2:41: error[RC")
    assert concise.endswith(
        "]: interface `Lasr` is not declared by any import (did you mean `Laser`?)\n"
    )
    github = rcgen("check", "a,b.cdsl", "--format", "github").out
    assert github.startswith(
        "::error file=a%2Cb.cdsl,line=2,col=41,endLine=2,endColumn=45,title=RC"
    )
    assert github.count("\n") == 1


def test_check_of_folder_checks_all_files(rcgen: Rcgen, here: Path) -> None:
    for name in ("one/a.cdsl", "one/two/b.CDSL", ".hidden/c.cdsl", "build/d.cdsl"):
        path = here / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(BAD)
    (here / "one" / "notes.xml").write_text("not for us")
    run = rcgen("check", ".", "--format", "json")
    assert [load["file"] for load in json.loads(run.out)] == ["one/a.cdsl", "one/two/b.CDSL"]
    assert rcgen("check", ".", ".").err == "2 files checked: 2 errors\n"


def test_check_syntax_resolves_no_imports(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(BAD)
    assert rcgen("check", "--syntax", "a.cdsl").code == 0


def test_check_searches_include_folders(rcgen: Rcgen, here: Path) -> None:
    (here / "lib").mkdir()
    (here / "lib" / "Own.idsl").write_text("module M { interface Own { void go(); }; };\n")
    (here / "a.cdsl").write_text(GOOD.replace("Laser", "Own"))
    assert rcgen("check", "a.cdsl").code == 1
    assert rcgen("check", "-I", "lib", "a.cdsl").code == 0


NOT_TEXTS = {
    "absent.cdsl": None,
    "empty.cdsl": b"",
    "binary.cdsl": bytes(range(256)) * 10,
    "latin.cdsl": "ñ".encode("latin-1"),
    "garbage.cdsl": b"}{)(;;; \x01 \x7f ] ] [ ;",
    "huge.cdsl": b"/" * (5 * 1024 * 1024),
    "unknown.txt": b"",
}


@pytest.mark.parametrize("name", NOT_TEXTS)
def test_check_reports_unreadable_input_with_location(rcgen: Rcgen, here: Path, name: str) -> None:
    data = NOT_TEXTS[name]
    if data is not None:
        (here / name).write_bytes(data)
    run = rcgen("check", name)
    assert run.code == 1
    assert f"--> {name}:" in run.out
    assert "error[RC" in run.out
    assert "Traceback" not in run.err


def test_check_without_files_is_usage_error(rcgen: Rcgen) -> None:
    run = rcgen("check")
    assert run.code == 2
    assert "Missing argument" in run.err


def test_check_uses_colours_only_on_terminals(
    rcgen: Rcgen, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (here / "a.cdsl").write_text(BAD)
    monkeypatch.delenv("NO_COLOR")
    assert "\x1b[" not in rcgen("check", "a.cdsl").out


@pytest.mark.parametrize("command", ["check", "fmt", "doc"])
def test_folder_without_description_files_is_an_error(
    rcgen: Rcgen, here: Path, command: str
) -> None:
    (here / "nothing").mkdir()
    done = rcgen(command, "nothing")
    assert done.code == 1
    assert done.err == "error: there are no description files in `nothing`\n"

"""`rcgen doc`: written and kept files, and exit codes."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

GOOD = (
    'import "Laser.idsl";\nComponent a { Communications { requires Laser; }; language Python; };\n'
)
BAD = GOOD.replace("requires Laser", "requires Lasr")
LEGACY = GOOD.replace("language Python;", "language Python; useQt qt4;")


def _tree(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


FORMS = [
    ((), {".html", ".css"}, "build/doc/index.html"),
    (("--format", "markdown", "-o", "out"), {".md", ".svg"}, "out/index.md"),
    (("--format", "both", "-o", "out"), {".html", ".css", ".md", ".svg"}, "out/index.html"),
]


@pytest.mark.parametrize(("arguments", "suffixes", "first"), FORMS)
def test_doc_writes_pages(
    rcgen: Rcgen, here: Path, arguments: tuple[str, ...], suffixes: set[str], first: str
) -> None:
    (here / "a.cdsl").write_text(GOOD)
    run = rcgen("doc", "a.cdsl", *arguments)
    assert (run.code, run.err) == (0, "")
    written = _tree((here / first).parent)
    assert {Path(path).suffix for path in written} == suffixes
    assert run.out == f"{first}: {len(written)} of {len(written)} files written\n"


def test_doc_is_idempotent(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    rcgen("doc", ".", "--format", "both")
    before = _tree(here)
    run = rcgen("doc", ".", "--format", "both")
    assert _tree(here) == before
    assert ": 0 of " in run.out
    assert rcgen("doc", ".", "-q").out == ""


def test_doc_output_is_independent_of_hash_seed(here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(GOOD.replace("t a", "t b").replace("requires", "implements"))
    code = "from robocomp_dsl.cli.rcgen.main import main; main()"
    trees = []
    for seed in ("1", "2"):
        command = [sys.executable, "-c", code, "doc", ".", "--title", "t", "--format", "both"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([*command, "-q", "-o", seed], env=environment, check=True)
        trees.append(_tree(here / seed))
    assert trees[0] == trees[1]
    assert len(trees[0]) > 10


def test_doc_leaves_out_file_with_error(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(BAD)
    run = rcgen("doc", ".")
    assert run.code == 1
    assert "  --> b.cdsl:2:41\n" in run.err
    assert (here / "build/doc/components").is_dir()
    assert "1 of 2 files has errors and is not documented: `b.cdsl`" in run.err


def test_doc_reports_error_in_parameter_file(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD.replace("language", 'parameters "a.pdsl"; language'))
    (here / "a.pdsl").write_text("ComponentParams a { rate float 50 60:70; };")
    run = rcgen("doc", "a.cdsl")
    assert run.code == 1
    assert "a.pdsl:1:" in run.err


def test_doc_succeeds_with_warnings(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(LEGACY)
    run = rcgen("doc", "a.cdsl")
    assert run.code == 0
    assert "warning[" in run.err
    assert (here / "build/doc/components/a.html").is_file()


def test_doc_keeps_foreign_files(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "docs").mkdir()
    (here / "docs" / "index.md").write_text("mine\n")
    before = _tree(here)
    run = rcgen("doc", "a.cdsl", "--format", "markdown", "-o", "docs")
    assert run.code == 1
    assert "`docs/index.md` is not a page of an earlier run" in run.err
    assert _tree(here) == before


def test_doc_lists_stale_pages(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(GOOD.replace("Component a", "Component b"))
    rcgen("doc", ".", "-o", "out")
    (here / "out" / "components" / "mine.html").write_text("mine\n")
    (here / "b.cdsl").unlink()
    run = rcgen("doc", ".", "-o", "out")
    assert run.code == 0
    assert run.out.endswith("; stale pages of an earlier run remain: components/b.html\n")
    assert (here / "out" / "components" / "mine.html").read_text() == "mine\n"
    assert (here / "out" / "components" / "b.html").is_file()


def test_doc_writes_one_page_per_declaration(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "x.pdsl").write_text("ComponentParams x { rate int 1; };")
    (here / "b.cdsl").write_text(
        GOOD.replace("Component a", "Component b").replace(
            "language", 'parameters "x.pdsl"; statemachine "s.smdsl"; language'
        )
    )
    (here / "s.smdsl").write_text(
        "s { initial_state one; end_state two; transitions { one => two; }; };"
    )
    (here / "c.cdsl").write_text(GOOD.replace("t a", "t c").replace("requires", "implements"))
    for name in ("one", "two"):
        imports = "".join(f'import "{name}.cdsl"; ' for name in "abc")
        (here / f"{name}.ddsl").write_text(
            f"{imports} Deployment {name} {{ component a; component b; component c; }};"
        )
    run = rcgen("doc", ".", "./a.cdsl", "-o", "out")
    assert (run.code, run.err) == (0, "")
    names = {path for path in _tree(here / "out") if "/" in path}
    assert {path for path in names if not path.startswith(("interfaces", "modules"))} == {
        "components/a.html",
        "components/b.html",
        "components/c.html",
        "deployments/one.html",
        "deployments/two.html",
    }
    assert "parameter.rate" in (here / "out/components/b.html").read_text()
    assert "State machine s" in (here / "out/components/b.html").read_text()


EXIT_USAGE = [
    (("body.xml",), 2, "bodies have no documentation"),
    (("nothing",), 1, "there are no description files in `nothing`"),
    (("missing.cdsl",), 1, "the file does not exist"),
    (("notes.txt",), 1, "unknown file suffix: `notes.txt`"),
    ((), 2, "Missing argument"),
]


@pytest.mark.parametrize(("arguments", "code", "message"), EXIT_USAGE)
def test_doc_usage_errors(
    rcgen: Rcgen, here: Path, arguments: tuple[str, ...], code: int, message: str
) -> None:
    (here / "nothing").mkdir()
    (here / "notes.txt").write_text("x")
    run = rcgen("doc", *arguments)
    assert (run.code, message in run.err) == (code, True)
    assert not (here / "build").exists()


def test_doc_reports_unwritable_folder(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    run = rcgen("doc", "a.cdsl", "-o", "a.cdsl")
    assert (run.code, run.err) == (1, "error: `a.cdsl` is a file, not a folder\n")


def test_doc_title(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    rcgen("doc", "a.cdsl", "--title", "My <Robot>")
    assert "<h1>My &lt;Robot&gt;</h1>" in (here / "build/doc/index.html").read_text()

"""`rcgen doc`: what is written where, what is never touched, and how it ends."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from rcgen_run import Rcgen

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


@pytest.mark.parametrize(("given", "suffixes", "first"), FORMS)
def test_what_is_written(
    rcgen: Rcgen, here: Path, given: tuple[str, ...], suffixes: set[str], first: str
) -> None:
    (here / "a.cdsl").write_text(GOOD)
    run = rcgen("doc", "a.cdsl", *given)
    assert (run.code, run.err) == (0, "")
    written = _tree((here / first).parent)
    assert {Path(path).suffix for path in written} == suffixes
    assert run.out == f"{first}: {len(written)} of {len(written)} files written\n"


def test_again_there_is_nothing_to_write(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    rcgen("doc", ".", "--format", "both")
    before = _tree(here)
    run = rcgen("doc", ".", "--format", "both")
    assert _tree(here) == before
    assert ": 0 of " in run.out
    assert rcgen("doc", ".", "-q").out == ""


def test_the_same_bytes_whatever_the_hash_seed(here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(GOOD.replace("t a", "t b").replace("requires", "implements"))
    code = "from robocomp_dsl.cli.rcgen import main; main()"
    trees = []
    for seed in ("1", "2"):
        command = [sys.executable, "-c", code, "doc", ".", "--title", "t", "--format", "both"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([*command, "-q", "-o", seed], env=environment, check=True)
        trees.append(_tree(here / seed))
    assert trees[0] == trees[1]
    assert len(trees[0]) > 10


def test_an_error_is_shown_in_place_and_nothing_is_written(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(BAD)
    run = rcgen("doc", ".")
    assert (run.code, run.out) == (1, "")
    assert "  --> b.cdsl:2:41\n" in run.err
    assert set(_tree(here)) == {"a.cdsl", "b.cdsl"}


def test_an_error_in_a_parameter_file_counts(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD.replace("language", 'parameters "a.pdsl"; language'))
    (here / "a.pdsl").write_text("ComponentParams a { rate float 50 60:70; };")
    run = rcgen("doc", "a.cdsl")
    assert run.code == 1
    assert "a.pdsl:1:" in run.err


def test_warnings_do_not_stop_it(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(LEGACY)
    run = rcgen("doc", "a.cdsl")
    assert run.code == 0
    assert "warning[" in run.err
    assert (here / "build/doc/components/a.html").is_file()


def test_a_file_of_somebody_else_is_not_written_over(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "docs").mkdir()
    (here / "docs" / "index.md").write_text("mine\n")
    before = _tree(here)
    run = rcgen("doc", "a.cdsl", "--format", "markdown", "-o", "docs")
    assert run.code == 1
    assert "`docs/index.md` is not a page of an earlier run" in run.err
    assert _tree(here) == before


def test_other_files_stay_and_pages_left_over_are_named(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    (here / "b.cdsl").write_text(GOOD.replace("Component a", "Component b"))
    rcgen("doc", ".", "-o", "out")
    (here / "out" / "components" / "mine.html").write_text("mine\n")
    (here / "b.cdsl").unlink()
    run = rcgen("doc", ".", "-o", "out")
    assert run.code == 0
    assert run.out.endswith("; pages of an earlier run are left: components/b.html\n")
    assert (here / "out" / "components" / "mine.html").read_text() == "mine\n"
    assert (here / "out" / "components" / "b.html").is_file()


def test_what_is_in_two_files_has_one_page(rcgen: Rcgen, here: Path) -> None:
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
        imports = "".join(f'import "{one}.cdsl"; ' for one in "abc")
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


USAGE = [
    (("body.xml",), 2, "bodies have no documentation"),
    (("nothing",), 1, "there are no descriptions in `nothing`"),
    (("missing.cdsl",), 1, "there is no such file"),
    (("notes.txt",), 1, "cannot tell the language"),
    ((), 2, "Missing argument"),
]


@pytest.mark.parametrize(("given", "code", "said"), USAGE)
def test_wrong_use(rcgen: Rcgen, here: Path, given: tuple[str, ...], code: int, said: str) -> None:
    (here / "nothing").mkdir()
    (here / "notes.txt").write_text("x")
    run = rcgen("doc", *given)
    assert (run.code, said in run.err) == (code, True)
    assert not (here / "build").exists()


def test_a_place_that_cannot_be_written(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    run = rcgen("doc", "a.cdsl", "-o", "a.cdsl")
    assert (run.code, run.err) == (1, "error: `a.cdsl` is a file, not a folder\n")


def test_the_title(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    rcgen("doc", "a.cdsl", "--title", "My <Robot>")
    assert "<h1>My &lt;Robot&gt;</h1>" in (here / "build/doc/index.html").read_text()

"""`rcgen breaking`: against a git revision and against a folder."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

IDSL = "module M { struct P { float x [mm]; }; interface I { P get(); }; };\n"


def git(folder: Path, *arguments: str) -> None:
    who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *who, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def history(here: Path) -> Path:
    """A git repository with one commit and an uncommitted change."""
    (here / "sub").mkdir()
    (here / "sub" / "M.idsl").write_text(IDSL)
    git(here, "init", "-q")
    git(here, "add", ".")
    git(here, "commit", "-qm", "first")
    (here / "sub" / "M.idsl").write_text(IDSL.replace("float x [mm]", "double x [m]"))
    return here


def test_breaking_against_revision(rcgen: Rcgen, history: Path) -> None:
    run = rcgen("breaking", "--against", "HEAD")
    assert run.code == 1
    assert "error[RC641]: `M::P.x` was float, now double\n  --> sub/M.idsl:1:30" in run.out
    assert "warning[RC644]: `M::P.x` was in mm, now in m" in run.out
    assert run.out.endswith(". against HEAD: 1 error, 1 warning\n")
    assert (history / "sub" / "M.idsl").read_text() != IDSL


@pytest.mark.parametrize("path", ["sub", "sub/M.idsl"])
def test_breaking_of_part_of_tree(rcgen: Rcgen, history: Path, path: str) -> None:
    run = rcgen("breaking", path, "--against", "HEAD", "--format", "json")
    assert [load["code"] for load in json.loads(run.out)] == ["RC641", "RC644"]


def test_breaking_against_folder(rcgen: Rcgen, history: Path) -> None:
    (history / "old").mkdir()
    (history / "old" / "N.idsl").write_text(IDSL)
    run = rcgen("breaking", "sub", "--against", "old")
    assert (run.code, run.out.count("error[")) == (1, 1)
    (history / "sub" / "M.idsl").write_text(IDSL)
    run = rcgen("breaking", "sub", "--against", "old")
    assert (run.code, run.out) == (0, "sub against old: no findings\n")


def test_breaking_against_unknown_version(rcgen: Rcgen, history: Path) -> None:
    run = rcgen("breaking", "--against", "v9")
    assert run.code == 1
    assert "neither such a git revision nor such a folder" in run.err


def test_breaking_requires_valid_new_version(rcgen: Rcgen, history: Path) -> None:
    (history / "sub" / "M.idsl").write_text("module M { struct P { Nothing x; }; };\n")
    run = rcgen("breaking", "--against", "HEAD")
    assert run.code == 1
    assert "fix these errors first" in run.err


def test_breaking_names_removed_file_as_git_does(rcgen: Rcgen, history: Path) -> None:
    git(history, "tag", "v1")
    (history / "sub" / "M.idsl").write_text(IDSL.replace("interface I", "interface J"))
    run = rcgen("breaking", "--against", "v1", "--format", "concise")
    assert run.out == "v1:sub/M.idsl:1:50: error[RC641]: interface `M::I` was removed\n"


def test_breaking_reports_errors_of_old_version(rcgen: Rcgen, history: Path) -> None:
    (history / "sub" / "N.idsl").write_text("module N { struct\n")
    git(history, "add", ".")
    git(history, "commit", "-qm", "broken")
    (history / "sub" / "N.idsl").unlink()
    run = rcgen("breaking", "--against", "HEAD")
    assert run.code == 0
    assert "`HEAD:sub/N.idsl` had errors in the earlier version" in run.err


CDSL = """\
import "I.idsl";
Component c { Communications { implements I; }; language Python; parameters "c.pdsl"; };
"""


@pytest.fixture
def component(here: Path) -> Path:
    """A component in a folder, its interface in another one."""
    for name in ("c", "idsl"):
        (here / name).mkdir()
    (here / "c" / "c.cdsl").write_text(CDSL)
    (here / "c" / "c.pdsl").write_text("ComponentParams c { g { h[1:3] { a int 1 0:9; }; }; };\n")
    (here / "idsl" / "I.idsl").write_text("module M { interface I { int f(); }; };\n")
    git(here, "init", "-q")
    git(here, "add", ".")
    git(here, "commit", "-qm", "first")
    return here


def test_breaking_searches_old_interface_folders(rcgen: Rcgen, component: Path) -> None:
    (component / "idsl" / "I.idsl").write_text("module M { interface J { int f(); }; };\n")
    (component / "c" / "c.cdsl").write_text(CDSL.replace("implements I", "implements J"))
    run = rcgen("breaking", "c", "--against", "HEAD", "-I", "idsl", "--format", "concise")
    assert run.out == "c/c.cdsl:2:11: error[RC641]: `c` implements `M::I` no longer\n"
    assert run.err == "", "the old component was checked with the old interfaces"


def test_breaking_matches_renamed_parameter_set_by_component(rcgen: Rcgen, component: Path) -> None:
    text = (component / "c" / "c.pdsl").read_text()
    (component / "c" / "c.pdsl").write_text(text.replace("Params c", "Params d"))
    assert rcgen("breaking", "c", "--against", "HEAD", "-I", "idsl").code == 0
    (component / "c" / "c.pdsl").write_text(
        text.replace("Params c", "Params d").replace("0:9", "0:5")
    )
    run = rcgen("breaking", "c", "--against", "HEAD", "-I", "idsl", "--format", "concise")
    assert "c/c.pdsl:1:34: error[RC643]: parameter `g.h.a` accepted 0 to 9, now 0 to 5" in run.out


def test_breaking_outside_git_repository(rcgen: Rcgen, here: Path) -> None:
    (here / "M.idsl").write_text(IDSL)
    for against in ("HEAD", "", "-x"):
        run = rcgen("breaking", f"--against={against}")
        assert (run.code, run.out) == (1, "")
        assert run.err.startswith("error: ")

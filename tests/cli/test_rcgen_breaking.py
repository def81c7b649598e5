"""`rcgen breaking`: against a git revision and against a folder."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from rcgen_run import Rcgen

IDSL = "module M { struct P { float x [mm]; }; interface I { P get(); }; };\n"


def git(folder: Path, *arguments: str) -> None:
    who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *who, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def history(here: Path) -> Path:
    """A git tree with one commit, and a change behind it."""
    (here / "sub").mkdir()
    (here / "sub" / "M.idsl").write_text(IDSL)
    git(here, "init", "-q")
    git(here, "add", ".")
    git(here, "commit", "-qm", "first")
    (here / "sub" / "M.idsl").write_text(IDSL.replace("float x [mm]", "double x [m]"))
    return here


def test_against_a_revision(rcgen: Rcgen, history: Path) -> None:
    run = rcgen("breaking", "--against", "HEAD")
    assert run.code == 1
    assert "error[RC641]: `M::P.x` was float, now double\n  --> sub/M.idsl:1:30" in run.out
    assert "warning[RC644]: `M::P.x` was in mm, now in m" in run.out
    assert run.out.endswith(". against HEAD: 1 error, 1 warning\n")
    assert (history / "sub" / "M.idsl").read_text() != IDSL


@pytest.mark.parametrize("path", ["sub", "sub/M.idsl"])
def test_a_part_of_the_tree(rcgen: Rcgen, history: Path, path: str) -> None:
    run = rcgen("breaking", path, "--against", "HEAD", "--format", "json")
    assert [one["code"] for one in json.loads(run.out)] == ["RC641", "RC644"]


def test_against_a_folder(rcgen: Rcgen, history: Path) -> None:
    (history / "old").mkdir()
    (history / "old" / "N.idsl").write_text(IDSL)
    run = rcgen("breaking", "sub", "--against", "old")
    assert (run.code, run.out.count("error[")) == (1, 1)
    (history / "sub" / "M.idsl").write_text(IDSL)
    run = rcgen("breaking", "sub", "--against", "old")
    assert (run.code, run.out) == (0, "sub against old: no findings\n")


def test_no_such_version(rcgen: Rcgen, history: Path) -> None:
    run = rcgen("breaking", "--against", "v9")
    assert run.code == 1
    assert "neither such a git revision nor such a folder" in run.err


def test_the_new_version_is_wrong(rcgen: Rcgen, history: Path) -> None:
    (history / "sub" / "M.idsl").write_text("module M { struct P { Nothing x; }; };\n")
    run = rcgen("breaking", "--against", "HEAD")
    assert run.code == 1
    assert "mend these first" in run.err

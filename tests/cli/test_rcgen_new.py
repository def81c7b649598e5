"""`rcgen new` writes a start that checks clean and generates; `rcgen explain` knows every code."""

from __future__ import annotations

from pathlib import Path

import pytest
from rcgen_run import Rcgen

from robocomp_dsl.cli.explain import _codes, all_codes


def test_a_plain_component(rcgen: Rcgen, here: Path) -> None:
    run = rcgen("new", "watcher")
    assert (run.code, run.err) == (0, "")
    assert run.out.splitlines()[-1] == (
        "next: edit them, then  rcgen component watcher/watcher.cdsl"
    )
    assert sorted(p.name for p in (here / "watcher").iterdir()) == ["watcher.cdsl", "watcher.pdsl"]
    check = rcgen("check", "watcher")
    assert (check.code, check.out) == (0, "")
    assert rcgen("fmt", "--check", "watcher").code == 0
    assert rcgen("component", "watcher/watcher.cdsl").code == 0


def test_with_ports_and_interfaces_of_its_own(rcgen: Rcgen, here: Path) -> None:
    run = rcgen(
        "new", "arm", "--requires", "Laser", "--implements", "JointMotor", "--publishes",
        "JointMotorPublish", "--subscribes", "News", "--interface", "News", "--interface", "Arm",
        "-o", "there",
    )  # fmt: skip
    assert (run.code, run.err) == (0, "")
    check = rcgen("check", "there")
    assert (check.code, check.out) == (0, "")
    assert rcgen("fmt", "--check", "there").code == 0
    text = (here / "there" / "arm.cdsl").read_text()
    assert "implements JointMotor, Arm;" in text
    assert "subscribesTo News;" in text
    for file in ("Laser", "JointMotor", "News", "Arm"):
        assert f'import "{file}.idsl";' in text
    assert rcgen("component", "there/arm.cdsl").code == 0


def test_an_unknown_interface(rcgen: Rcgen, here: Path) -> None:
    run = rcgen("new", "arm", "--requires", "Lasr")
    assert run.code == 2
    assert "declares the interface `Lasr`; did you mean `Laser`?" in run.err
    assert list(here.iterdir()) == []


def test_an_interface_of_a_folder(rcgen: Rcgen, here: Path) -> None:
    (here / "lib").mkdir()
    (here / "lib" / "File.idsl").write_text("module M { interface Own { void go(); }; };\n")
    assert rcgen("new", "arm", "--requires", "Own", "-I", "lib").code == 0
    assert 'import "File.idsl";' in (here / "arm" / "arm.cdsl").read_text()


@pytest.mark.parametrize("name", ["1a", "a b", "a/b", "../a", "a;b", "{{a}}", "", "é", "a" * 200])
def test_bad_names(rcgen: Rcgen, here: Path, name: str) -> None:
    run = rcgen("new", name)
    assert run.code == 2
    assert "is no name" in run.err
    assert list(here.iterdir()) == []


@pytest.mark.parametrize("there", ["watcher.cdsl", "watcher.pdsl"])
def test_existing_files_stay(rcgen: Rcgen, here: Path, there: str) -> None:
    (here / there).write_text("mine")
    run = rcgen("new", "watcher", "-o", ".")
    assert run.code == 1
    assert run.err == f"error: `{there}` exists already; nothing was written\n"
    assert [(p.name, p.read_text()) for p in here.iterdir()] == [(there, "mine")]


def test_explain(rcgen: Rcgen) -> None:
    upper, lower = rcgen("explain", "RC601"), rcgen("explain", "rc601")
    assert upper == lower
    assert upper.code == 0
    assert upper.out.startswith("RC601 (error): nothing is generated for this language\n\n")


def test_explain_an_unknown_code(rcgen: Rcgen) -> None:
    run = rcgen("explain", "RC61I")
    assert run.code == 2
    assert "did you mean `RC" in run.err


def test_explain_all(rcgen: Rcgen) -> None:
    run = rcgen("explain")
    assert run.code == 0
    assert len(run.out.splitlines()) == len(all_codes()) > 50


def test_a_number_means_one_thing() -> None:
    assert len(set(_codes())) == len(all_codes())


@pytest.mark.parametrize("code", all_codes())
def test_every_code_is_explained(code: str) -> None:
    one = all_codes()[code]
    assert one.title
    assert not one.title.endswith(".")
    assert len(one.explanation) > 60

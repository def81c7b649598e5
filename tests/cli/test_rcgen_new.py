"""`rcgen new` writes a component without findings; `rcgen explain` explains every code."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.cli.rcgen.explain import STAGES, all_codes, stage_codes
from tests.cli.rcgen_run import Rcgen


def test_new_component(rcgen: Rcgen, here: Path) -> None:
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


def test_new_component_with_ports_and_interfaces(rcgen: Rcgen, here: Path) -> None:
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


def test_new_rejects_unknown_interface(rcgen: Rcgen, here: Path) -> None:
    run = rcgen("new", "arm", "--requires", "Lasr")
    assert run.code == 2
    assert "declares the interface `Lasr`; did you mean `Laser`?" in run.err
    assert list(here.iterdir()) == []


def test_new_finds_interface_in_folder(rcgen: Rcgen, here: Path) -> None:
    (here / "lib").mkdir()
    (here / "lib" / "File.idsl").write_text("module M { interface Own { void go(); }; };\n")
    assert rcgen("new", "arm", "--requires", "Own", "-I", "lib").code == 0
    assert 'import "../lib/File.idsl";' in (here / "arm" / "arm.cdsl").read_text()
    assert rcgen("check", "arm/arm.cdsl").code == 0


@pytest.mark.parametrize("name", ["1a", "a b", "a/b", "../a", "a;b", "{{a}}", "", "é", "a" * 200])
def test_new_rejects_invalid_names(rcgen: Rcgen, here: Path, name: str) -> None:
    run = rcgen("new", name)
    assert run.code == 2
    assert "is not a valid name" in run.err
    assert list(here.iterdir()) == []


@pytest.mark.parametrize("there", ["watcher.cdsl", "watcher.pdsl"])
def test_new_keeps_existing_files(rcgen: Rcgen, here: Path, there: str) -> None:
    (here / there).write_text("mine")
    run = rcgen("new", "watcher", "-o", ".")
    assert run.code == 1
    assert run.err == f"error: `{there}` exists already; nothing was written\n"
    assert [(p.name, p.read_text()) for p in here.iterdir()] == [(there, "mine")]


def test_explain_code(rcgen: Rcgen) -> None:
    upper, lower = rcgen("explain", "RC601"), rcgen("explain", "rc601")
    assert upper == lower
    assert upper.code == 0
    assert upper.out.startswith("RC601 (error): no generator for this language\n\n")


def test_explain_rejects_unknown_code(rcgen: Rcgen) -> None:
    run = rcgen("explain", "RC61I")
    assert run.code == 2
    assert "did you mean `RC" in run.err


def test_explain_lists_all_codes(rcgen: Rcgen) -> None:
    run = rcgen("explain")
    assert run.code == 0
    assert len(run.out.splitlines()) == len(all_codes()) > 50


def test_code_ids_are_unique() -> None:
    assert len({code for stage in STAGES for code in stage_codes(stage)}) == len(all_codes())


@pytest.mark.parametrize("code", all_codes())
def test_every_code_has_explanation(code: str) -> None:
    explained = all_codes()[code]
    assert explained.title
    assert not explained.title.endswith(".")
    assert len(explained.explanation) > 60

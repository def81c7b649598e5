"""`rcgen examples` lists what ships, and `rcgen new --example` copies it."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.cli.rcgen.shipped import example_files, examples
from robocomp_dsl.resources import COMPONENTS
from tests.cli.rcgen_run import Rcgen

TOUCH = {"touch_demo", "generic_arm", "reflex", "nao_simulator", "icub_simulator"}
WANDER = {"wander", "mobile_base", "path_logger"}


def test_examples_lists_every_shipped_folder(rcgen: Rcgen) -> None:
    run = rcgen("examples")
    rows = [line.split(maxsplit=2) for line in run.out.splitlines()]
    assert (run.code, run.err) == (0, "")
    names = {name for name, _, _ in rows}
    assert names == {p.name.removesuffix("_demo") for p in COMPONENTS.iterdir() if p.is_dir()}
    assert {kind for _, kind, _ in rows} == {"component", "demo", "robot"}
    for name, _, about in rows:
        readme = " ".join(examples()[name].folder.joinpath("README.md").read_text().split())
        assert about in readme
        assert about.endswith(".")
        assert len(about) < 100


@pytest.mark.parametrize("name", examples())
def test_new_example_copy_passes_check(rcgen: Rcgen, here: Path, name: str) -> None:
    run = rcgen("new", "robot", "--example", name)
    assert (run.code, run.err) == (0, "")
    place = f"robot/components/{examples()[name].folder.name}"
    start = run.out.splitlines()[-1].removeprefix(f"next: cd {place} && ")
    assert (here / place / start.split()[-1]).is_file()
    copied = [p for p in (here / "robot").rglob("*") if p.is_file()]
    assert {p.relative_to(here / "robot").as_posix() for p in copied} == {
        file.path for file in example_files(examples()[name])
    }
    for path in copied:
        shipped = COMPONENTS.parent / path.relative_to(here / "robot")
        assert path.read_bytes() == shipped.read_bytes()
    check = rcgen("check", "robot")
    assert (check.code, check.out) == (0, "")


@pytest.mark.parametrize(("name", "folders"), [("touch", TOUCH), ("wander", WANDER)])
def test_new_example_copies_components_of_deployment(
    rcgen: Rcgen, here: Path, name: str, folders: set[str]
) -> None:
    assert rcgen("new", "robot", "--example", name, "-o", "there").code == 0
    assert {p.name for p in (here / "there/components").iterdir()} == folders


@pytest.mark.parametrize(
    ("name", "hint"),
    [("tuch", "did you mean `touch`?"), ("qqqq", "`rcgen examples` lists them")],
)
def test_new_example_reports_unknown_name(rcgen: Rcgen, here: Path, name: str, hint: str) -> None:
    run = rcgen("new", "robot", "--example", name)
    assert run.code == 2
    assert f"there is no example `{name}`; {hint}" in run.err
    assert list(here.iterdir()) == []


def test_new_example_rejects_folder_with_files(rcgen: Rcgen, here: Path) -> None:
    (here / "robot").mkdir()
    (here / "robot/mine").write_text("mine")
    run = rcgen("new", "robot", "--example", "touch")
    assert run.code == 1
    assert run.err == "error: the folder `robot` is not empty; choose another name, or use -o DIR\n"
    assert [p.name for p in (here / "robot").iterdir()] == ["mine"]


def test_new_example_rejects_file_as_folder(rcgen: Rcgen, here: Path) -> None:
    (here / "robot").write_text("mine")
    run = rcgen("new", "robot", "--example", "touch")
    assert (run.code, run.err) == (1, "error: `robot` is a file, not a folder\n")
    assert (here / "robot").read_text() == "mine"


def test_new_example_rejects_port_options(rcgen: Rcgen, here: Path) -> None:
    run = rcgen("new", "robot", "--example", "touch", "--requires", "Laser")
    assert run.code == 2
    assert "--example copies a component with its ports" in run.err
    assert list(here.iterdir()) == []

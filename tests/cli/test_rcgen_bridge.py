"""`rcgen bridge`: output files, modes that write nothing, errors, and regeneration."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

BRIDGE = """\
/** Angles for the viewer. */
Bridge rover
{
    input left : double[] [deg] over yarp at "/left:o";
    function mirror(double[] values [rad]) -> double[] [rad];
    output angles : double[] [rad] over zenoh = mirror(left to [rad]);
};
"""
FILES = {
    "README.md",
    "RoverTypes.idsl",
    "etc/config.schema.json",
    "etc/config.yaml",
    "main.py",
    "rover.cdsl",
    "rover.ddsl",
    "rover.pdsl",
    "rover_generated/__init__.py",
    "rover_generated/bridge_worker.py",
    "rover_generated/genericworker.py",
    "rover_generated/interfaces.json",
    "rover_generated/interfaces.py",
    "rover_generated/mapping.py",
    "rover_generated/params.py",
    "specificworker.py",
}


@pytest.fixture
def rover(here: Path) -> Path:
    (here / "rover.bdsl").write_text(BRIDGE)
    return here


def tree(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def visible(folder: Path) -> set[str]:
    return {path for path in tree(folder) if not path.startswith(".rcgen")}


def test_bridge_is_written_beside_file(rcgen: Rcgen, rover: Path) -> None:
    run = rcgen("bridge", "rover.bdsl")
    assert (run.code, run.err) == (0, "")
    assert run.out == (
        ".: 16 of 16 files written; yours to edit: specificworker.py, etc/config.yaml, README.md\n"
    )
    assert visible(rover) == FILES | {"rover.bdsl"}
    assert rcgen("bridge", "rover.bdsl").out == (".: nothing to do, all 16 files are up to date\n")


def test_bridge_in_other_folder_has_copies_of_the_interfaces_beside_its_file(
    rcgen: Rcgen, rover: Path
) -> None:
    (rover / "Gaze.idsl").write_text(
        "module Eyes { interface Gaze { [publish] void at(double x); }; };\n"
    )
    text = 'import "Gaze.idsl";\n' + BRIDGE.replace(
        "};\n", '    input gaze : Eyes::Gaze.at over yarp at "/gaze:o";\n};\n'
    )
    (rover / "rover.bdsl").write_text(text)
    run = rcgen("bridge", "rover.bdsl", "-o", "out", "--format", "concise")
    assert run.code == 0, run.err
    assert visible(rover / "out") == FILES | {"Gaze.idsl"}
    assert rcgen("check", "out/rover.ddsl", "--format", "concise").code == 0


def test_descriptions_of_bridge_are_valid_and_formatted(rcgen: Rcgen, rover: Path) -> None:
    rcgen("bridge", "rover.bdsl")
    files = ["RoverTypes.idsl", "rover.cdsl", "rover.pdsl", "rover.ddsl"]
    assert rcgen("check", *files).out == ""
    assert rcgen("fmt", "--check", *files).code == 0


@pytest.mark.parametrize(
    ("mode", "code", "text"),
    [
        ("--check", 1, "`mapping.py` is missing"),
        ("--diff", 0, "+def output_angles("),
        ("--dry-run", 0, "rover_generated/mapping.py"),
    ],
)
def test_bridge_modes_write_nothing(
    rcgen: Rcgen, rover: Path, mode: str, code: int, text: str
) -> None:
    run = rcgen("bridge", "rover.bdsl", mode)
    assert run.code == code
    assert text.replace("`mapping.py`", "`rover_generated/mapping.py`") in run.out + run.err
    assert visible(rover) == {"rover.bdsl"}
    rcgen("bridge", "rover.bdsl")
    run = rcgen("bridge", "rover.bdsl", mode)
    assert run.code == 0
    assert text not in run.out.replace("unchanged ", "")[: 0 if mode == "--dry-run" else None]


def test_bridge_with_errors_writes_nothing(rcgen: Rcgen, rover: Path) -> None:
    (rover / "rover.bdsl").write_text(BRIDGE.replace("mirror(left", "mirror(right"))
    run = rcgen("bridge", "rover.bdsl")
    assert run.code == 1
    assert "right" in run.err
    assert visible(rover) == {"rover.bdsl"}


def test_bridge_of_missing_file_is_reported(rcgen: Rcgen, here: Path) -> None:
    run = rcgen("bridge", "nothing.bdsl")
    assert run.code == 1
    assert "nothing.bdsl" in run.err
    assert "Traceback" not in run.err


def test_regeneration_keeps_user_code_and_appends_functions(rcgen: Rcgen, rover: Path) -> None:
    rcgen("bridge", "rover.bdsl")
    worker = rover / "specificworker.py"
    mine = worker.read_text().replace("return super().mirror(values)", "return -values  # mine")
    worker.write_text(mine)
    config = rover / "etc" / "config.yaml"
    config.write_text(config.read_text().replace("angles:\n", "angles:  # mine\n"))
    more = "    function scale(double value, string name) -> double;\n    output angles"
    text = BRIDGE.replace("    output angles", more)
    text = text.replace("};\n", "    output second : double[] [deg] over zenoh = left;\n};\n")
    (rover / "rover.bdsl").write_text(text)
    preview = rcgen("bridge", "rover.bdsl", "--check")
    assert preview.code == 1
    assert worker.read_text() == mine
    run = rcgen("bridge", "rover.bdsl", "--format", "concise")
    assert run.code == 0
    new = worker.read_text()
    assert new.startswith(mine.rstrip("\n")[:-1])
    assert "return -values  # mine" in new
    assert "def scale(self, value: float, name: str) -> float:" in new
    assert "no method for the function `scale`" in run.err
    merged = config.read_text()
    assert "angles:  # mine" in merged
    assert "second:" in merged


def test_changed_function_is_reported(rcgen: Rcgen, rover: Path) -> None:
    rcgen("bridge", "rover.bdsl")
    text = BRIDGE.replace("mirror(double[] values [rad])", "mirror(double[] values [rad], int n)")
    (rover / "rover.bdsl").write_text(text.replace("to [rad])", "to [rad], 1)"))
    run = rcgen("bridge", "rover.bdsl", "--format", "concise")
    assert "the signature of `mirror` has changed" in run.err


def test_rcgen_component_leaves_generated_bridge_as_it_is(rcgen: Rcgen, rover: Path) -> None:
    rcgen("bridge", "rover.bdsl")
    before = tree(rover)
    run = rcgen("component", "rover.cdsl")
    assert (run.code, run.err) == (0, "")
    after = tree(rover)
    changed = {path for path in after if before.get(path) != after[path]}
    assert all(path.startswith(".rcgen") for path in changed)
    run = rcgen("bridge", "rover.bdsl")
    assert "nothing to do" in run.out

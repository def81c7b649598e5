"""`rcgen simulator` at the command line: the dry run, and worlds that cannot be simulated."""

from __future__ import annotations

from pathlib import Path

import pytest
from worlds import ROOM, rcgen

TABLE = """\
device       kind               interface          port
robot        differentialrobot  DifferentialRobot  robot
platform     omnirobot          OmniRobot          platform
laser        laser              Laser              laser
neck         joint              JointMotor         JointMotor
neck         joint              ControlBoard       ControlBoard
inertia      imu                IMU                inertia
bump         touchsensor        TouchSensor        TouchSensor
(the world)  world              InnerModelManager  InnerModelManager
(the world)  world              Simulation         Simulation
"""


def test_a_dry_run_lists_what_is_served_and_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "room.xml").write_text(ROOM)
    done = rcgen("simulator", "room.xml", "--dry-run", cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, TABLE, "")
    assert [path.name for path in tmp_path.iterdir()] == ["room.xml"]


BAD = {
    '<innerModel><gps id="g" latitude="95"/></innerModel>': "world.xml:1:13",
    '<innerModel><battery id="b" capacity="0"/></innerModel>': "world.xml:1:13",
    '<innerModel><ultrasound id="u" min="9" max="3"/></innerModel>': "world.xml:1:13",
    "<innerModel><laser/></innerMode>": "world.xml:1:",
    '<innerModel><transform id="a" tx="wide"/></innerModel>': "world.xml:1:34",
    '<innerModel><lazer id="a"/></innerModel>': "world.xml:1:14",
    '<innerModel><transform id="a"/><transform id="a"/></innerModel>': "world.xml:1:",
    '<innerModel><laser id="a"/><laser id="a"/></innerModel>': "world.xml:1:",
    '<innerModel><transform id="a" tx="1e400"/></innerModel>': "world.xml:1:",
    '<innerModel><differentialrobot id="a"/><joint id="a.z"/></innerModel>': "RC632",
}


@pytest.mark.parametrize("text", BAD)
def test_bad_worlds_are_told_with_their_place(tmp_path: Path, text: str) -> None:
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--format", "concise", cwd=tmp_path)
    assert done.returncode == 1
    assert BAD[text] in done.stderr
    assert "Traceback" not in done.stderr
    assert "internal error" not in done.stderr
    assert not (tmp_path / "world_simulator").exists()


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    done = rcgen("simulator", "none.xml", cwd=tmp_path)
    assert done.returncode == 1
    assert "none.xml" in done.stderr


def test_what_is_simplified_is_a_warning_at_its_place(tmp_path: Path) -> None:
    text = '<innerModel>\n <mesh id="m" file="gone.stl"/>\n</innerModel>'
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--dry-run", "--format", "concise", cwd=tmp_path)
    assert done.returncode == 0
    assert "world.xml:2:2" in done.stderr
    assert "RC633" in done.stderr


def test_a_world_may_be_called_world(tmp_path: Path) -> None:
    """MuJoCo has a body of that name itself; most worlds of RoboComp have one, too."""
    (tmp_path / "world.xml").write_text(
        '<innerModel><transform id="world"><laser id="l"/></transform></innerModel>'
    )
    done = rcgen("simulator", "world.xml", "--dry-run", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")

"""`rcgen simulator` at the command line: the dry run, and worlds that cannot be simulated."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.simulation.served_worlds import ROOM, rcgen

TABLE = """\
device       kind               interface           port
robot        differentialrobot  DifferentialRobot   robot
platform     omnirobot          OmniRobot           platform
robot        differentialrobot  GenericBase         robot_base
platform     omnirobot          GenericBase         platform_base
robot        differentialrobot  FullPoseEstimation  robot_pose
platform     omnirobot          FullPoseEstimation  platform_pose
laser        laser              Laser               laser
neck         joint              JointMotor          JointMotor
neck         joint              ControlBoard        ControlBoard
inertia      imu                IMU                 inertia
bump         touchsensor        TouchSensor         TouchSensor
(the world)  world              InnerModelManager   InnerModelManager
(the world)  world              Simulation          Simulation
"""


def test_simulation_command_dry_run_lists_servants_and_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "room.xml").write_text(ROOM)
    done = rcgen("simulator", "room.xml", "--dry-run", cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, TABLE, "")
    assert [path.name for path in tmp_path.iterdir()] == ["room.xml"]


# what is wrong, where that is told, and what becomes of it
WRONG = {
    '<innerModel><gps id="g" latitude="95"/></innerModel>': (
        "world.xml:1:13: error[RC808]",
        "`g`: `latitude` is 84 here",
    ),
    '<innerModel><battery id="b" capacity="0"/></innerModel>': (
        "world.xml:1:13: error[RC808]",
        "`b`: `capacity` is 0.001 here",
    ),
    '<innerModel><ultrasound id="u" min="9" max="3"/></innerModel>': (
        "world.xml:1:13: error[RC808]",
        "`u`: `min` is 3 and `max` 9 here",
    ),
    '<innerModel><camera id="c" width="-3"/></innerModel>': (
        "world.xml:1:13: warning[RC633]",
        "`c`: `width` is 1 here",
    ),
    '<innerModel><laser id="l"></innerModel>': (
        "world.xml:1:14: error[RC",
        "1 place repaired in its XML",
    ),
    '<innerModel><transform id="a" tx="wide"/></innerModel>': (
        "world.xml:1:34: error[RC803]",
        "1 value replaced by the default",
    ),
    '<innerModel><lazer id="a"/><imu id="i"/></innerModel>': (
        "world.xml:1:14: error[RC801]",
        "1 tag left out",
    ),
    '<innerModel><laser id="a"/><laser id="a"/></innerModel>': (
        "world.xml:1:38: error[RC804]",
        "1 node renamed",
    ),
    '<innerModel><translation id="a" x="5"/><include path="b.xml"/></innerModel>': (
        "world.xml:1:33: error[RC802]",
        "1 attribute left out or taken as another, 1 file not included",
    ),
    '<innerModel><skin id="s"><patch file="a"/><patch file="b"/></skin></innerModel>': (
        "world.xml:1:26: error[RC821]",
        "2 places of skin simplified",
    ),
    '<innerModel><skin id="s"><patch x1="9" r0="5" r1="5" rings="1"/></skin></innerModel>': (
        "world.xml:1:26: error[RC808]",
        "1 node simplified",
    ),
    '<innerModel><joint id="a" min="2" max="1"/></innerModel>': (
        "world.xml:1:13: error[RC808]",
        "1 node simplified",
    ),
    # parts of worlds are often nothing but what they include, from folders of another machine
    '<innermodel><include path="/home/x/a.xml"/><include path="b.xml"/></innermodel>': (
        "world.xml:1:27: error[RC806]",
        "2 files not included",
    ),
    '<innerModel><lazer id="a"/></innerModel>': (
        "world.xml:1:14: error[RC801]",
        "1 tag left out",
    ),
}


@pytest.mark.parametrize("text", WRONG)
def test_simulation_command_simulates_rest_despite_errors(tmp_path: Path, text: str) -> None:
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--dry-run", "--format", "concise", cwd=tmp_path)
    assert done.returncode == 0
    place, consequence = WRONG[text]
    assert place in done.stderr
    assert consequence in done.stderr
    assert "InnerModelManager" in done.stdout


def test_simulation_command_strict_run_writes_nothing_on_errors(tmp_path: Path) -> None:
    text = '<innerModel><imu id="i"/><lazer id="l"/></innerModel>'
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--strict", "--format", "concise", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (1, "")
    assert "world.xml:1:27: error[RC801]" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["world.xml"]


IMPOSSIBLE = {
    "<rcmanager><node/></rcmanager>": "world.xml:1:2",
    "a text": "world.xml:1:1",
    "": "world.xml:1:1",
}


@pytest.mark.parametrize("text", IMPOSSIBLE)
def test_simulation_command_reports_invalid_worlds_with_position(tmp_path: Path, text: str) -> None:
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--format", "concise", cwd=tmp_path)
    assert done.returncode == 1
    assert IMPOSSIBLE[text] in done.stderr
    assert "Traceback" not in done.stderr
    assert "internal error" not in done.stderr
    assert not (tmp_path / "world_simulator").exists()


def test_simulation_command_reports_missing_file(tmp_path: Path) -> None:
    done = rcgen("simulator", "none.xml", cwd=tmp_path)
    assert done.returncode == 1
    assert "none.xml" in done.stderr


def test_simulation_command_warns_about_simplifications_with_position(tmp_path: Path) -> None:
    text = '<innerModel>\n <mesh id="m" file="gone.stl"/>\n</innerModel>'
    (tmp_path / "world.xml").write_text(text)
    done = rcgen("simulator", "world.xml", "--dry-run", "--format", "concise", cwd=tmp_path)
    assert done.returncode == 0
    assert "world.xml:2:2" in done.stderr
    assert "RC788" in done.stderr
    assert done.stderr.count("warning") == 1


def test_simulation_command_accepts_world_called_world(tmp_path: Path) -> None:
    """MuJoCo has a body of that name itself; most worlds of RoboComp have one, too."""
    (tmp_path / "world.xml").write_text(
        '<innerModel><transform id="world"><laser id="l"/></transform></innerModel>'
    )
    done = rcgen("simulator", "world.xml", "--dry-run", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


APART = """\
<innerModel>
 <plane id="ground" ny="1" size="9000,9000,50" py="-25" collide="1"/>
 <transform id="table"><plane id="top" ny="1" size="800,400,100" py="500" collide="1"/></transform>
 <transform id="crate" engine="bullet" mass="1" tx="30" ty="{y}">
  <plane id="side" ny="1" size="100,100,100" collide="1"/>
 </transform>
</innerModel>
"""


@pytest.mark.parametrize(
    ("y", "message"),
    [
        (600, ""),
        (560, "world.xml:4:2: warning[RC653]: `crate` and `table` overlap by 40 mm\n"),
        (37.5, "world.xml:4:2: warning[RC653]: `crate` and `ground` overlap by 12.5 mm\n"),
    ],
)
def test_simulation_command_reports_overlap_at_start(
    tmp_path: Path, y: float, message: str
) -> None:
    (tmp_path / "world.xml").write_text(APART.format(y=y))
    done = rcgen("simulator", "world.xml", "--dry-run", "--format", "concise", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, message)
    assert "crate" not in done.stdout

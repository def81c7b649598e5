"""Range finders of MJCF behind `Ultrasound`."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.simulation.served_worlds import Served, rcgen, served, served_model

ROBOT = """\
<mujoco>
  <worldbody>
    <geom name="wall" type="box" size="0.05 4 4" pos="3.05 0 0"/>
    <body name="robot" pos="1 2 0.5">
      <joint type="slide" axis="1 0 0" name="rail" range="-9 9" armature="1"/>
      <geom type="box" size="0.1 0.1 0.1" mass="1"/>
      <body name="head" pos="0 0 0.2">
        <geom type="box" size="0.05 0.05 0.05" mass="0.1"/>
        <site name="nose" pos="0.05 0 0" zaxis="1 0 0"/>
        <site name="crown" pos="0 0 0.05"/>
        <site name="back" pos="0 -0.05 0" zaxis="0 -1 0"/>
        <camera name="eye" resolution="2 1"/>
      </body>
    </body>
  </worldbody>
  <sensor>
    <rangefinder name="front" site="nose"/>
    <rangefinder name="sky" site="crown" cutoff="3"/>
    <rangefinder site="back"/>
    <rangefinder name="grid" camera="eye"/>
  </sensor>
</mujoco>
"""
FARTHEST = 1_000_000


@pytest.fixture
def world(tmp_path: Path) -> Served:
    world_served = served_model(tmp_path, ROBOT)
    world_served.simulation.advance(0.01)
    return world_served


def test_range_finder_measures_distances(world: Served) -> None:
    sonars = world.ports["Ultrasound"]
    assert [getAllSensorParam.name for getAllSensorParam in sonars.getAllSensorParams()] == [
        "front",
        "sky",
        "sensor2",
    ]
    assert sonars.getAllSensorDistances().tolist() == pytest.approx([1950, 3000, FARTHEST], abs=1)
    world.ports["ControlBoard"].setReferenceSpeed([], [1.0])
    world.ports["ControlBoard"].positionMove([], [0.5])
    world.simulation.advance(2.0)
    assert sonars.getSensorDistance("front") == pytest.approx(1450, abs=5)


def test_range_finder_positions_are_in_robot_frame(world: Served) -> None:
    """The robot looks along its y axis; right of that is x."""
    front, _, back = world.ports["Ultrasound"].getAllSonarPose()
    assert (front.x, front.y, front.angle) == pytest.approx((50, 0, math.pi / 2), abs=1e-3)
    assert (back.x, back.y, abs(back.angle)) == pytest.approx((0, -50, math.pi), abs=1e-3)


def test_range_finder_servant_refuses_unknown_name(world: Served) -> None:
    with pytest.raises(world.types.UnknownSensorException, match="front, sky, sensor2"):
        world.ports["Ultrasound"].getSensorDistance("grid")


def test_range_finder_noise_is_that_of_sensor(tmp_path: Path) -> None:
    world = served_model(tmp_path, ROBOT.replace('site="nose"', 'site="nose" noise="0.02"'))
    sonars, seen = world.ports["Ultrasound"], []
    for _ in range(200):
        world.simulation.advance(0.05)
        seen.append(sonars.getSensorDistance("front"))
    spread = math.sqrt(sum((distance - 1950) ** 2 for distance in seen) / len(seen))
    assert spread == pytest.approx(20, rel=0.25)
    assert sonars.getSensorDistance("sky") == 3000  # nothing has no error


def test_range_finder_servant_lists_sensors(tmp_path: Path) -> None:
    (tmp_path / "robot.xml").write_text(ROBOT)
    done = rcgen("simulator", "robot.xml", "--dry-run", cwd=tmp_path)
    rows = [line.split() for line in done.stdout.splitlines()]
    assert ["front", "model_range", "Ultrasound", "Ultrasound"] in rows
    assert ["sensor2", "model_range", "Ultrasound", "Ultrasound"] in rows
    assert ["grid", "manyranges", "-", "-"] in rows


@pytest.mark.parametrize("wrapped", [True, False], ids=["world", "root"])
def test_range_finders_of_the_room_see_the_room(tmp_path: Path, wrapped: bool) -> None:
    """Fixed in the room itself: its walls are not part of a robot that carries them."""
    inside = """<laser id="laser" measures="3" max="5000" angle="0.1"/>
      <ultrasound id="sonar" max="5000"/>
      <plane id="wall" nz="-1" pz="2025" size="3000,3000,50"/>"""
    text = f'<transform id="world">{inside}</transform>' if wrapped else inside
    world = served(tmp_path, f"<innerModel>{text}</innerModel>")
    assert world.ports["laser"].getLaserData()[1].dist == pytest.approx(2000, abs=1)
    assert world.ports["Ultrasound"].getSensorDistance("sonar") == pytest.approx(2000, abs=1)

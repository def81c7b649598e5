"""LimbContacts sensors and bumpers feel contact forces of the physics."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.simulation.served_worlds import served

TABLE = """\
<innerModel>
  <touchsensor id="scale" max="20">
    <plane id="plate" ny="1" size="1000,1000,20" collide="1"/>
  </touchsensor>
  <touchsensor id="under" ny="-1">
    <plane id="lower" ny="1" py="-100" size="1000,1000,20" collide="1"/>
  </touchsensor>
  <transform id="crate" engine="bullet" mass="1.2" ty="100">
    <touchsensor id="foot" type="bumper">
      <plane id="side" size="100,100,100" collide="1"/>
    </touchsensor>
  </transform>
</innerModel>
"""


def test_touch_sensor_measures_falling_crate(tmp_path: Path) -> None:
    world = served(tmp_path, TABLE)
    read = world.ports["TouchSensor"].getValues
    world.simulation.advance(0.02)
    assert {name: item.value for name, item in read().items()} == dict.fromkeys(read(), 0.0)
    world.simulation.advance(2.0)
    values = {name: item.value for name, item in read().items()}
    assert values.pop("scale") == pytest.approx(1.2 * 9.81, rel=0.02)
    assert values == {"under": 0.0, "foot": 1.0}


def test_touch_sensor_value_stays_in_bounds(tmp_path: Path) -> None:
    world = served(tmp_path, TABLE.replace('mass="1.2"', 'mass="12"'))
    world.simulation.advance(2.0)
    assert world.ports["TouchSensor"].getValues()["scale"].value == 20.0


def test_touch_sensor_measures_along_its_normal_only(tmp_path: Path) -> None:
    for normal, force in (('ny="1"', 1.2 * 9.81), ('ny="-1"', 0.0), ('nx="1"', 0.0)):
        text = TABLE.replace('id="scale"', f'id="scale" {normal}')
        world = served(tmp_path, text)
        world.simulation.advance(2.0)
        found = world.ports["TouchSensor"].getValues()["scale"].value
        assert found == pytest.approx(force, rel=0.02, abs=0.05), normal

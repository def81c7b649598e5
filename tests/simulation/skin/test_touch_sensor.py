"""LimbContacts sensors and bumpers feel contact forces of the physics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.simulation.served_worlds import Served, rcgen, served

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


def mistake(world: Served, operation: str, *arguments: Any) -> str:
    with pytest.raises(world.types.InnerModelManagerError) as raised:
        getattr(world.ports["InnerModelManager"], operation)(*arguments)
    assert raised.value.err.name == "InvalidValues"
    return str(raised.value.text)


@pytest.mark.parametrize(
    ("operation", "arguments"), [("removeNode", ("side",)), ("moveNode", ("side", "root"))]
)
def test_touch_sensor_keeps_its_last_shape(
    tmp_path: Path, operation: str, arguments: tuple[str, ...]
) -> None:
    """Without a shape it would read 0 for ever: the change is rejected, the world continues."""
    world = served(tmp_path, TABLE)
    found = mistake(world, operation, *arguments)
    assert found.startswith("`foot` would never feel anything: no shape in it collides")
    world.simulation.advance(2.0)
    read = world.ports["TouchSensor"].getValues
    assert read()["foot"].value == 1.0
    assert world.ports["InnerModelManager"].removeNode("foot")  # with its shape: it is gone
    assert set(read()) == {"scale", "under"}


def test_touch_sensor_with_unreadable_mesh_is_left_out(tmp_path: Path) -> None:
    """A mesh that cannot be read becomes a marker that touches nothing; the rest is simulated."""
    mesh = '<mesh id="pad" file="gone.obj" collide="1"/>'
    text = TABLE.replace('<plane id="side" size="100,100,100" collide="1"/>', mesh)
    world = served(tmp_path, text)
    assert set(world.ports["TouchSensor"].getValues()) == {"scale", "under"}
    assert "`foot` is left out: no shape in it collides" in world.simulation.notes
    world.simulation.advance(0.1)
    world.ports["Simulation"].reset()
    assert set(world.ports["TouchSensor"].getValues()) == {"scale", "under"}


def test_touch_sensor_without_shape_is_left_out_of_simulator(tmp_path: Path) -> None:
    """The rest of a world with errors is simulated."""
    (tmp_path / "world.xml").write_text(
        TABLE.replace('<plane id="side" size="100,100,100" collide="1"/>', "")
    )
    done = rcgen("simulator", "world.xml", "--dry-run", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "RC784" in done.stderr
    assert "1 touch sensor left out" in done.stderr
    sensors = [line for line in done.stdout.splitlines() if "touchsensor" in line]
    assert [line.split()[0] for line in sensors] == ["scale", "under"]
    assert rcgen("simulator", "world.xml", "--strict", cwd=tmp_path).returncode == 1

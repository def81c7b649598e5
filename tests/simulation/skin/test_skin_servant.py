"""Skin of a world in InnerModel: served, told with every new frame, right in sum and place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.simulation.served_worlds import assert_clean, rcgen, run, served, with_simulator

TABLE = """\
<innerModel>
  <transform id="table">
    <plane id="top" ny="1" py="-25" size="400,400,50" collide="1"/>
    <skin id="touch" rate="50">
      <patch id="fine" firstid="100" gain="0.05" floor="2" saturation="240">
{taxels}
      </patch>
    </skin>
  </transform>
  <transform id="weight" tx="{x}" ty="29.9" tz="{z}" engine="bullet" mass="{mass}">
    <plane id="cube" size="60,60,60" ny="1" collide="1"/>
  </transform>
</innerModel>
"""
PITCH = 8.0


def table(x: float = 0.0, z: float = 0.0, mass: float = 0.1, side: int = 12) -> str:
    """A square of taxels on a table, and a cube of `mass` kg on it at (x, z) mm."""
    at = [(i - (side - 1) / 2) * PITCH for i in range(side)]
    rows = [f'        <taxel x="{a:g}" z="{b:g}" ny="1"/>' for a in at for b in at]
    return TABLE.format(taxels="\n".join(rows), x=x, z=z, mass=mass)


def test_skin_servant_measures_weight_of_cube(tmp_path: Path) -> None:
    it = served(tmp_path, table())
    skin = it.ports["Skin"]
    geometry = skin.getGeometry()
    assert geometry.version == 1
    assert geometry.id.tolist() == list(range(100, 244))
    assert [(limb.name, limb.body) for limb in geometry.limbs] == [("touch", "table")]
    (patch,) = geometry.patches
    assert (patch.name, patch.gain) == ("fine", pytest.approx(0.05))
    assert (patch.floor, patch.saturation) == (2, 240)
    assert (geometry.y == 0).all()
    assert (geometry.ny == 1).all()
    it.simulation.advance(1.0)
    frame = skin.getFrame()
    assert (frame.sequence, frame.geometry) == (50, 1)
    assert frame.time == pytest.approx(1.0)
    assert frame.force.sum() == pytest.approx(0.981, rel=0.02)
    centre = [frame.force @ getattr(geometry, axis) / frame.force.sum() for axis in "xyz"]
    assert centre == pytest.approx([0, 0, 0], abs=0.003)
    assert frame.offSkin == 0.0
    corners = skin.getContacts().contacts
    assert sum(corner.force for corner in corners) == pytest.approx(0.981, rel=0.02)
    assert sum(corner.taxels for corner in corners) == np.count_nonzero(frame.force)
    assert sorted((round(corner.x, 2), round(corner.z, 2)) for corner in corners) == [
        (-0.03, -0.03),
        (-0.03, 0.03),
        (0.03, -0.03),
        (0.03, 0.03),
    ]
    assert all(corner.ny == pytest.approx(1.0) for corner in corners)


HEAR = """
skin = proxy(i.SKIN, "Skin")
geometry = skin.getGeometry()
frames, touches = [], []
for port, into in (("SkinFrame", frames), ("SkinContacts", touches)):
    interface = getattr(i, port + "Proxy").INTERFACE
    operation = interface.operations[0].name
    topic = Endpoint(interface, "client", port)
    middleware.subscribe(topic, {operation: into.append}, CallbackGroup())
until(lambda: len(frames) > 20 and frames[-1].time > 1 and len(touches) > 5)
for one in frames[-10:]:  # it lies still
    assert abs(float(one.force.sum()) - 0.981) < 0.02, float(one.force.sum())
    assert one.geometry == geometry.version == 1
numbers = [one.sequence for one in frames]
assert numbers == list(range(numbers[0], numbers[0] + len(numbers))), numbers
apart = [b.time - a.time for a, b in zip(frames, frames[1:])]
assert all(abs(one - 0.02) < 1e-9 for one in apart), apart
assert abs(sum(one.force for one in touches[-1].contacts) - 0.981) < 0.02
assert skin.getFrame().sequence >= numbers[-1]
refusal_of(i.HardwareFailedException, skin.calibrate, 1.0)
print("felt")
"""


SET_UP = """
skin, component = proxy(i.SKIN, "Skin"), proxy(COMPONENT, "Component")
frames = []
topic = Endpoint(i.SkinFrameProxy.INTERFACE, "client", "SkinFrame")
middleware.subscribe(topic, {"frame": frames.append}, CallbackGroup())
def change(**values):
    component.setParameters({"skin." + name: str(value) for name, value in values.items()})
    frames.clear()
until(lambda: frames and frames[-1].time > 1)
change(raw="true", shear="false", dead="100-171")
until(lambda: frames and len(frames[-1].raw) and not len(frames[-1].shearX))
assert abs(float(frames[-1].force.sum()) - 0.981 / 2) < 0.02  # half of the table is dead
assert frames[-1].raw[:72].tolist() == [240] * 72
assert "no taxel 7" in str(refusal_of(Refusal, lambda: change(dead="7")))
assert "is no taxel" in str(refusal_of(Refusal, lambda: change(dead="x")))
change(dead="", rate="200")
until(lambda: len(frames) > 10)
assert frames[-1].time - frames[-11].time < 0.06
change(rate="50", threshold="5")
until(lambda: len(frames) > 2)
assert frames[-1].force.sum() == 0
change(threshold="0", saturation="0.02")
until(lambda: len(frames) > 2)
assert abs(float(frames[-1].force.max()) - 0.02) < 1e-6
change(saturation="12", noise="0.05", drift="1")
until(lambda: len(frames) > 2)
assert float(frames[-1].force.std()) > 0.01
change(noise="0", drift="0", compensation="true")
skin.calibrate(0.2)
until(lambda: len(frames) > 20)
assert frames[-1].force.sum() == 0  # the cube was there when it was calibrated
change(compensation="false")
until(lambda: frames and abs(float(frames[-1].force.sum()) - 0.981) < 0.02)
print("set up")
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The component of the table, generated by the command."""
    home = tmp_path_factory.mktemp("table")
    (home / "table.xml").write_text(table())
    done = rcgen("simulator", "table.xml", cwd=home)
    assert (done.returncode, done.stderr) == (0, "")
    return home / "table_simulator"


def test_skin_simulator_is_clean_and_typed(folder: Path) -> None:
    assert_clean(folder)


@pytest.mark.parametrize("middleware", ["inproc", "zenoh"])
def test_skin_servant_publishes_frames(folder: Path, middleware: str) -> None:
    code = with_simulator(middleware, HEAR)
    domain = f"test-{folder.parent.name}-{middleware}"
    assert run(folder, code, middleware, domain, "table_simulator") == "felt\n"


def test_skin_servant_is_configured_while_running(folder: Path) -> None:
    head = """
from robocomp_dsl.runtime.component.component_interface import COMPONENT, Refusal
"""
    code = with_simulator("zenoh", head + SET_UP)
    domain = f"test-{folder.parent.name}-set-up"
    assert run(folder, code, "zenoh", domain, "table_simulator") == "set up\n"

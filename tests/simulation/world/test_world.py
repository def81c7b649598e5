import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.devices.differential_robot import Mechanics
from robocomp_dsl.hardware.devices.errors import Diverged, SceneError
from robocomp_dsl.hardware.devices.laser import LaserSettings
from robocomp_dsl.simulation.devices.differential_robot import DifferentialRobot
from robocomp_dsl.simulation.devices.laser import Laser
from robocomp_dsl.simulation.scene.room import Room, Wall
from robocomp_dsl.simulation.world.world import World

ROOM = Room(walls=(Wall(-2000, 1500, 2000, 1500, 100, 1000),))


def run(seed: int, slices: int) -> tuple[np.ndarray, np.ndarray]:
    robot = DifferentialRobot(Mechanics(), drift=0.01)
    laser = Laser(LaserSettings(noise=10.0))
    world = World(ROOM.spec(), (robot, laser), seed=seed)
    for i in range(40):
        robot.set_speed(400, math.sin(i))
        for _ in range(slices):
            world.advance(0.1 / slices)
    return world.data.qpos.copy(), laser.scan().distances


def test_world_is_bit_identical_for_same_seed() -> None:
    position, scan = run(5, 1)
    again, same_scan = run(5, 1)
    assert np.array_equal(position, again)
    assert np.array_equal(scan, same_scan)
    assert not np.array_equal(scan, run(6, 1)[1])


def test_world_is_independent_of_advance_sizes() -> None:
    """Parts of a step are kept for the next call, so no time is lost or won."""
    assert np.array_equal(run(5, 1)[0], run(5, 3)[0])


def test_world_raises_diverged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    world = World(ROOM.spec(), (DifferentialRobot(Mechanics()),))
    world.advance(0.1)
    world.data.qvel[:] = np.nan
    with pytest.raises(Diverged, match=r"diverged before 0\.2"):
        world.advance(0.1)
    assert "unstable" in caplog.text
    assert not list(tmp_path.iterdir())  # left alone, MuJoCo would write a log file here


def test_world_raises_scene_error_for_invalid_spec() -> None:
    spec = ROOM.spec()
    spec.worldbody.add_body(name="ghost").add_freejoint()  # it has no mass
    with pytest.raises(SceneError, match="MuJoCo cannot build the world"):
        World(spec)


SWING = """<mujoco><option timestep="0.001"/>
<worldbody><body><joint name="j" axis="0 1 0"/><geom size=".1" pos=".3 0 0"/>
<site name="s" pos=".3 0 0"/></body></worldbody><sensor>{}</sensor></mujoco>"""
QUICK = '<jointpos joint="j"/><accelerometer site="s"/><gyro site="s"/>'
LATE = QUICK + '<jointpos joint="j" nsample="8" delay="0.005"/>'


@pytest.mark.parametrize("sensors", [QUICK, LATE], ids=["quick", "late"])
def test_world_sensors_read_last_step(sensors: str) -> None:
    """In the steps between nobody looks at them; a late one remembers these all the same."""
    received = []
    for times in (1, 20):
        world = World(mujoco.MjSpec.from_string(SWING.format(sensors)))
        for _ in range(times):
            world.advance(0.02 / times)
        received.append((world.time, *world.data.sensordata))
    assert received[0] == received[1]
    assert np.count_nonzero(received[0]) > 4

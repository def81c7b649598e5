"""Satellite receivers, ultrasonic range finders and batteries."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint, offset, utm
from tests.simulation.served_worlds import served

WORLD = """\
<innerModel>
  <plane id="wall" nz="-1" pz="2025" py="100" size="6000,1000,50"/>
  <differentialrobot id="robot">
    <gps id="gps" latitude="45" longitude="3" altitude="300 m"/>
    <battery id="cells" capacity="0.1" voltage="12" idle="20"/>
    <transform id="bow" ty="100" tz="150"><ultrasound id="front" max="3000"/></transform>
    <transform id="side" ty="100" tx="100" ry="1.57079632679"><ultrasound id="right"/></transform>
  </differentialrobot>
</innerModel>
"""


def test_gps_servant_converts_metres_to_degrees_and_utm() -> None:
    # on the central meridian at 45°, the meridian's length is 4984944.378 m (WGS 84)
    zone, band, east, north = utm(GeoPoint(45.0, 3.0, 0.0))
    assert (zone, band) == (31, "T")
    assert (east, north) == pytest.approx((500_000, 0.9996 * 4_984_944.378), abs=0.01)
    moved = offset(GeoPoint(45.0, 3.0, 0.0), 300.0, 400.0, 5.0)
    _, _, east, north = utm(moved)
    assert math.hypot(east - 500_000, north - 4_982_950.400) == pytest.approx(499.8, abs=0.05)
    assert utm(GeoPoint(-33.9, 151.2, 0.0))[:2] == (56, "H")


def test_gps_servant_follows_robot(tmp_path: Path) -> None:
    world = served(tmp_path, WORLD)
    gps = world.ports["gps"]
    fixed, latitude, longitude, altitude = gps.getData()
    assert fixed
    assert (latitude, longitude, altitude) == pytest.approx((45, 3, 300))
    gps.resetPos()
    world.ports["robot"].setSpeedBase(500.0, 0.0)
    world.simulation.advance(2.0)
    _, x, y, z = gps.getPos()
    assert (x, y, z) == pytest.approx(
        (0, 0, world.ports["robot"].getBaseState().correctedZ), abs=60
    )
    assert z > 700
    assert gps.getUTMData()[4] - 4_982_950.400 == pytest.approx(z / 1000, abs=0.01)


def test_sonar_servant_measures_distance_ahead(tmp_path: Path) -> None:
    world = served(tmp_path, WORLD)
    sonars = world.ports["Ultrasound"]
    world.simulation.advance(0.1)
    assert sonars.getSonarsNumber() == 2
    assert sonars.getSensorDistance("front") == pytest.approx(1850, abs=2)
    assert sonars.getAllSensorDistances().tolist()[1] == 4000
    poses = sonars.getAllSonarPose()
    assert (poses[0].x, poses[0].y, poses[0].angle) == pytest.approx((0, 150, 0), abs=1e-3)
    assert (poses[1].x, poses[1].y, poses[1].angle) == pytest.approx((100, 0, 1.5708), abs=1e-3)
    with pytest.raises(world.types.UnknownSensorException, match="front, right"):
        sonars.getSensorDistance("back")


def test_sonar_noise_is_as_declared(tmp_path: Path) -> None:
    world = served(tmp_path, WORLD.replace('max="3000"', 'max="3000" noise="10"'))
    distances = []
    for _ in range(200):
        world.simulation.advance(0.05)
        distances.append(world.ports["Ultrasound"].getSensorDistance("front"))
    assert np.std(distances) == pytest.approx(10, rel=0.2)


def test_battery_discharges_faster_while_driving(tmp_path: Path) -> None:
    left = []
    for speed in (0.0, 800.0):
        world = served(tmp_path, WORLD)
        world.ports["robot"].setSpeedBase(speed, 0.0)
        world.simulation.advance(2.0)
        state = world.ports["cells"].getBatteryState()
        assert (state.state.name, state.voltage) == ("Disconnected", 12.0)
        left.append(state.percentage)
    # 0.1 Wh are 360 J: 40 J for standing; and 20 kg at 0.8 m/s have 6.4 J more
    assert left[0] == pytest.approx(100 - 100 * 40 / 360, abs=0.1)
    assert left[1] == pytest.approx(left[0] - 100 * 6.4 / 360, abs=0.4)


def test_empty_battery_stays_empty(tmp_path: Path) -> None:
    world = served(tmp_path, WORLD.replace('capacity="0.1"', 'capacity="0.001"'))
    world.simulation.advance(1.0)
    state = world.ports["cells"].getBatteryState()
    assert (state.percentage, state.voltage, state.current) == (0.0, 0.0, 0.0)

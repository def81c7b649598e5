import math
from dataclasses import replace

import numpy as np
import pytest

from robocomp_dsl.hardware.devices.differential_robot import Mechanics
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.devices.laser import LaserDevice, LaserSettings
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose
from robocomp_dsl.simulation.devices.differential_robot import DifferentialRobot
from robocomp_dsl.simulation.devices.laser import Laser, LaserMount
from robocomp_dsl.simulation.scene.room import Pillar, Room, Wall
from robocomp_dsl.simulation.world.world import World

CENTRE = LaserMount(z=0.0)
WIDE = LaserSettings(measures=181, degrees=180, min_range=100, max_range=6000)
AHEAD = Room(walls=(Wall(-9000, 3050, 9000, 3050, 100, 1000),))


def scanned(
    room: Room, settings: LaserSettings = WIDE, mount: LaserMount = CENTRE, start: Pose = ORIGIN
) -> tuple[World, DifferentialRobot, Laser]:
    robot = DifferentialRobot(Mechanics(), start)
    laser = Laser(settings, mount)
    return World(room.spec(), (robot, laser), seed=3), robot, laser


def test_laser_rays_go_from_left_to_right() -> None:
    angles = LaserSettings(measures=5, degrees=180).angles()
    assert angles.tolist() == pytest.approx(
        [-math.pi / 2, -math.pi / 4, 0, math.pi / 4, math.pi / 2]
    )
    assert LaserSettings(measures=1).angles().tolist() == [0]


def test_laser_measures_wall_at_every_angle() -> None:
    laser: LaserDevice = scanned(AHEAD)[2]
    scan = laser.scan()
    expected = np.minimum(3000 / np.maximum(np.cos(scan.angles.astype(float)), 1e-9), 6000)
    assert scan.distances == pytest.approx(expected, abs=0.5)
    assert scan.distances.dtype == scan.angles.dtype == np.float32


def test_laser_angle_is_positive_to_the_right() -> None:
    scan = scanned(Room(pillars=(Pillar("", 2000, 2000, 100, 1000),)))[2].scan()
    assert scan.angles[scan.distances.argmin()] == pytest.approx(math.pi / 4, abs=0.01)
    assert scan.distances.min() == pytest.approx(math.hypot(2000, 2000) - 100, abs=2)


def test_laser_clips_distances_to_its_range() -> None:
    near = replace(WIDE, min_range=3500.0)
    assert scanned(AHEAD, near)[2].scan().distances.min() == 3500
    far = replace(WIDE, max_range=2500.0)
    assert set(scanned(AHEAD, far)[2].scan().distances) == {2500}
    assert set(scanned(Room())[2].scan().distances) == {6000}


def test_laser_does_not_see_the_robot_that_carries_it() -> None:
    low = LaserMount(y=100.0, z=0.0)  # in the middle of the hull, between the wheels
    scan = scanned(AHEAD, mount=low)[2].scan()
    assert scan.distances[90] == pytest.approx(3000, abs=0.5)
    assert scan.distances.min() > 2990


def test_laser_turns_with_the_robot() -> None:
    world, robot, laser = scanned(AHEAD)
    robot.set_speed(0, 1.0)
    world.advance(math.pi / 4)
    scan = laser.scan()
    straight = scan.angles[scan.distances.argmin()]
    assert -straight == pytest.approx(robot.true_pose().alpha, abs=0.05)


def test_laser_noise_has_declared_width_and_repeats_with_seed() -> None:
    noisy = replace(WIDE, noise=20.0)
    first = scanned(AHEAD, noisy)[2].scan().distances
    again = scanned(AHEAD, noisy)[2].scan().distances
    clean = scanned(AHEAD)[2].scan().distances
    hit = clean < 5900
    assert np.array_equal(first, again)
    assert np.std((first - clean)[hit]) == pytest.approx(20, rel=0.2)
    assert np.array_equal(first[clean == 6000], clean[clean == 6000])  # no echo, no noise


def test_laser_scans_come_at_their_period_for_all_readers() -> None:
    world, robot, laser = scanned(AHEAD, replace(WIDE, period=0.1, noise=5.0))
    robot.set_speed(300, 0)
    seen = []
    for _ in range(60):
        world.advance(0.01)
        if laser.scan().time not in seen:
            seen.append(laser.scan().time)
    assert seen == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6], abs=1e-6)

    rare_world, rare_robot, rare = scanned(AHEAD, replace(WIDE, period=0.1, noise=5.0))
    rare_robot.set_speed(300, 0)
    rare_world.advance(0.6)
    assert np.array_equal(rare.scan().distances, laser.scan().distances)


def test_laser_scan_is_read_only() -> None:
    scan = scanned(AHEAD)[2].scan()
    with pytest.raises(ValueError, match="read-only"):
        scan.distances[0] = 1


def test_laser_requires_a_body() -> None:
    with pytest.raises(SceneError, match="mounted on `mast`, which is no body"):
        scanned(AHEAD, mount=LaserMount(body="mast"))

"""`RGBD`: what a camera with depth serves besides its simple interface; pictures as a topic."""

from __future__ import annotations

import math
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.simulation.devices.camera import Camera
from robocomp_dsl.simulation.view.offscreen import NoRendering
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.simulation.served_worlds import Served, served
from tests.support.waiting import wait_until

WORLD = """\
<innerModel>
  <differentialrobot id="robot" tz="100">
    <joint id="neck" axis="y" min="-1" max="1">
      <transform id="stand" ty="500"><rgbd id="eye" width="80" height="60" focal="60"/></transform>
    </joint>
  </differentialrobot>
  <plane id="wall" nz="-1" pz="2025" py="500" px="-1000" size="2000,4000,50" texture="#ff0000"/>
</innerModel>
"""


@pytest.fixture
def world(tmp_path: Path) -> Served:
    world_served = served(tmp_path, WORLD)
    world_served.simulation.advance(0.1)
    return world_served


def test_rgbd_servant_returns_matching_colours_distances_and_points(world: Served) -> None:
    colours, depths, points, joints, base = world.ports["eye"].getImage()
    assert len(colours) == len(depths) == len(points) == 80 * 60
    wall = np.isfinite(depths)
    assert depths[wall] == pytest.approx(1900, rel=2e-3)
    assert (colours.column("red")[wall] > 100).all()
    assert (points.column("w") == wall).all()
    x, y, z = (points.column(name).reshape(60, 80) for name in "xyz")
    at = (10, 20)  # above the middle, on the left
    assert z[at] == depths.reshape(60, 80)[at]
    assert x[at] == pytest.approx((20 - 39.5) / 60 * 1900, rel=3e-3)
    assert y[at] == pytest.approx((29.5 - 10) / 60 * 1900, rel=3e-3)
    nothing = (30, 70)
    assert (z[nothing], points.column("w").reshape(60, 80)[nothing]) == (1, 0)
    assert x[nothing] == pytest.approx((70 - 39.5) / 60)
    assert set(joints) == {"neck"}
    assert base.correctedZ == pytest.approx(100, abs=1)


def test_rgbd_servant_returns_same_data_in_all_formats(world: Served) -> None:
    port = world.ports["eye"]
    colours, depths, points, *_ = port.getImage()
    data, far, *_ = port.getData()
    assert (data.reshape(-1, 3)[:, 1] == colours.column("green")).all()
    assert (far == depths).all()
    assert (port.getDepth()[0] == depths).all()
    assert (port.getDepthInIR()[0] == depths).all()
    assert (port.getRGB()[0].column("blue") == colours.column("blue")).all()
    assert (port.getXYZ()[0].column("x") == points.column("x")).all()
    stream = port.getXYZByteStream()[0].view("<f4").reshape(-1, 4)
    assert (stream[:, 1] == points.column("y")).all()


def test_rgbd_servant_reports_configuration(world: Served) -> None:
    port = world.ports["eye"]
    received = port.getRGBDParams()
    assert (received.color.width, received.color.height, received.color.focal) == (80, 60, 60)
    assert (received.color.FPS, received.timerPeriod, received.color.size) == (15, 67, 80 * 60 * 3)
    assert (received.talkToBase, received.talkToJointMotor, received.device) == (True, True, "eye")
    assert port.getRegistration().name == "DepthInColor"
    port.setRegistration(world.types.Registration.ColorInDepth)
    assert port.getRegistration().name == "ColorInDepth"


def test_rgbd_servant_without_robot_has_no_states(tmp_path: Path) -> None:
    world = served(tmp_path, '<innerModel><rgbd id="eye" width="8" height="6"/></innerModel>')
    depths, joints, base = world.ports["eye"].getDepth()
    assert (len(depths), joints) == (48, {})
    assert base == world.types.TBaseState()
    received = world.ports["eye"].getRGBDParams()
    assert (received.talkToBase, received.talkToJointMotor) == (False, False)


def test_camera_picture_is_published_once(world: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where time is simulated, it is waited for."""
    monkeypatch.setattr(Simulation, "on_deployment_clock", True)
    port = world.ports["CameraRGBDSimple"]
    ((image, depth),) = port.poll()
    assert (image.width, image.alivetime) == (80, depth.alivetime)
    assert port.poll() == []
    world.simulation.advance(0.08)
    ((later, _),) = port.poll()
    assert later.alivetime == image.alivetime + 80


def test_exposure_does_not_wait_in_real_time(
    world: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    port, plain, shutter = world.ports["CameraRGBDSimple"], Camera.picture, threading.Event()

    def held(camera: Camera) -> Any:
        assert shutter.wait(60)
        return plain(camera)

    monkeypatch.setattr(Camera, "picture", held)
    assert port.poll() == []  # it is being taken
    shutter.set()
    ((image, _),) = wait_until(port.poll, "the picture has not been taken")
    assert image.alivetime == round(world.simulation.world.time * 1000)


def test_camera_servant_without_rendering_publishes_the_rest(
    world: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    def cannot(_: object) -> None:
        raise NoRendering("no library")

    monkeypatch.setattr(Camera, "picture", cannot)
    monkeypatch.setattr(Simulation, "on_deployment_clock", True)
    assert world.ports["CameraRGBDSimple"].poll() == []
    monkeypatch.undo()
    monkeypatch.setattr(Simulation, "on_deployment_clock", True)
    assert world.ports["CameraRGBDSimple"].poll() == []  # it is not tried again


def test_rgbd_servant_does_not_publish_removed_camera(world: Served) -> None:
    port = world.ports["CameraRGBDSimple"]
    world.ports["InnerModelManager"].removeNode("stand")
    assert port.poll() == []
    with pytest.raises(Exception, match="removed"):
        world.ports["eye"].getDepth()
    assert not math.isnan(world.simulation.world.time)

"""Cameras: colours and depths are those of the scene before them, drawn without a screen."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.simulation.devices import camera
from robocomp_dsl.simulation.view.picture import Renderer
from tests.simulation.served_worlds import served
from tests.support.waiting import wait_until

EYES = """\
<innerModel>
  <transform id="stand" ty="500">
    <rgbd id="eye" width="80" height="60" focal="60"/>
    <camera id="plain" width="40" height="30" focal="30"/>
  </transform>
  <plane id="wall" nz="-1" pz="2025" py="500" px="-1000" size="2000,4000,50" texture="#ff0000"/>
  <plane id="far" nz="-1" pz="3025" py="1500" px="1000" size="2000,2000,50" texture="#0000ff"/>
</innerModel>
"""


def test_camera_depth_and_points_match_walls(tmp_path: Path) -> None:
    world = served(tmp_path, EYES)
    world.simulation.advance(0.01)
    seen = world.ports["CameraRGBDSimple"].getAll("eye")
    depth = seen.depth.depth.view(np.float32).reshape(60, 80)
    assert depth[30, 20] == pytest.approx(2000, rel=2e-3)  # the red wall is on the left
    assert depth[10, 60] == pytest.approx(3000, rel=2e-3)  # the blue one on the right, above
    assert depth[50, 60] == math.inf  # and nothing below it
    colour = seen.image.image.reshape(60, 80, 3).astype(int)
    assert colour[30, 20].argmax() == 0
    assert colour[10, 60].argmax() == 2
    assert (seen.image.width, seen.image.height, seen.image.depth) == (80, 60, 3)
    points = seen.points.points
    z = points.column("z")
    assert sorted({round(float(depth), -1) for depth in z}) == [2000, 3000]
    blue = z > 2500
    assert points.column("x")[blue].min() > -60
    assert points.column("y")[blue].min() > -60  # above the eye, which looks ahead at 500 mm


def test_camera_without_depth_has_same_colours(tmp_path: Path) -> None:
    world = served(tmp_path, EYES)
    image = world.ports["plain"].getImage()
    colours = image.image.reshape(30, 40, 3).astype(int)
    assert colours[15, 10].argmax() == 0
    assert colours[5, 30].argmax() == 2


def test_camera_takes_one_picture_per_period(tmp_path: Path) -> None:
    world = served(tmp_path, EYES)
    port = world.ports["CameraRGBDSimple"]
    first = port.getImage("eye").alivetime
    world.simulation.advance(0.04)
    assert port.getImage("eye").alivetime == first
    world.simulation.advance(0.04)
    assert port.getImage("eye").alivetime == first + 80


def test_camera_noise_is_as_declared(tmp_path: Path) -> None:
    world = served(tmp_path, EYES.replace('focal="60"', 'focal="60" noise="30"'))
    depth = world.ports["CameraRGBDSimple"].getDepth("eye").depth.view(np.float32).reshape(60, 80)
    wall = depth[:, 2:38]
    assert wall.std() == pytest.approx(30, rel=0.15)
    assert wall.mean() == pytest.approx(2000, abs=5)


def test_camera_servant_refuses_unknown_cameras(tmp_path: Path) -> None:
    world = served(tmp_path, EYES)
    with pytest.raises(Exception, match="no camera `ear`: eye") as raised:
        world.ports["CameraRGBDSimple"].getImage("ear")
    assert type(raised.value).__name__.endswith("HardwareFailedException")


def test_camera_shows_changed_world(tmp_path: Path) -> None:
    world = served(tmp_path, EYES)
    port = world.ports["CameraRGBDSimple"]
    port.getImage("eye")
    world.ports["InnerModelManager"].removeNode("wall")
    world.simulation.advance(0.1)
    depth = port.getDepth("eye").depth.view(np.float32).reshape(60, 80)
    assert depth[30, 20] == math.inf


class CountedRenderer(Renderer):
    """A renderer that counts the rendering contexts which are not freed yet."""

    in_use = 0

    def __init__(self, *args: object) -> None:
        super().__init__(*args)
        CountedRenderer.in_use += 1

    def __exit__(self, *args: object) -> None:
        super().__exit__(*args)
        CountedRenderer.in_use -= 1


def test_removed_camera_frees_rendering_context(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(camera, "Renderer", CountedRenderer)
    world = served(tmp_path, EYES)
    remove = world.ports["InnerModelManager"].removeNode
    for end in (world.simulation.stop, world.simulation.reset, lambda: remove("stand")):
        world.simulation.reset()
        world.ports["plain"].getImage()
        assert CountedRenderer.in_use == 1
        end()
        wait_until(lambda: CountedRenderer.in_use == 0, "the rendering context is freed")

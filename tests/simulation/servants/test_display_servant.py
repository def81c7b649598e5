"""Displays: what is shown on them is what cameras of the world see there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tests.simulation.served_worlds import Served, served

WORLD = """\
<innerModel>
  <rgbd id="eye" width="80" height="60" focal="60"/>
  <transform id="wall" tz="1000">
    <display id="face" nz="-1" size="800,600,10" texture="#00ff00"/>
  </transform>
</innerModel>
"""
RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
CORNERS = np.array([[RED, WHITE], [GREEN, BLUE]], np.uint8)
PLACES = {
    "upper left": (20, 25),
    "upper right": (20, 55),
    "lower left": (40, 25),
    "lower right": (40, 55),
}


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, WORLD)


def visible_places(world: Served) -> dict[str, tuple[bool, ...]]:
    """Which of red, green, blue shine in each corner of the display."""
    world.simulation.advance(0.1)  # or the camera tells the picture that it has
    image = world.ports["CameraRGBDSimple"].getImage("eye")
    pixels = image.image.reshape(60, 80, 3).astype(int)
    return {name: tuple((pixels[at] > 100).tolist()) for name, at in PLACES.items()}


def image_of(world: Served, pixels: np.ndarray) -> Any:
    height, width, depth = pixels.shape
    return world.types.Image(width=width, height=height, depth=depth, Img=pixels.ravel())


AS_CORNERS = {
    "upper left": (True, False, False),
    "upper right": (True, True, True),
    "lower left": (False, True, False),
    "lower right": (False, False, True),
}


def test_display_starts_with_its_colour(world: Served) -> None:
    assert set(visible_places(world).values()) == {(False, True, False)}


def test_display_shows_image_in_right_orientation(world: Served) -> None:
    visible_places(world)  # the camera has its context already
    world.ports["face"].setImage(image_of(world, CORNERS))
    assert visible_places(world) == AS_CORNERS
    grey = np.full((3, 5, 1), 255, np.uint8)
    world.ports["face"].setImage(image_of(world, grey))
    assert set(visible_places(world).values()) == {(True, True, True)}


def test_display_shows_image_from_file(world: Served, tmp_path: Path) -> None:
    Image.fromarray(CORNERS).save(tmp_path / "corners.png")
    world.ports["face"].setImageFromFile(str(tmp_path / "corners.png"))
    assert visible_places(world) == AS_CORNERS


def test_display_stays_when_the_world_is_built_again_and_goes_with_a_reset(world: Served) -> None:
    world.ports["face"].setImage(image_of(world, CORNERS))
    plane = world.types.Plane3D(0, 0, 3000, 0, 0, -1, 10, 10, 10, "#ffffff")
    world.ports["InnerModelManager"].addPlane("more", "root", plane)
    assert visible_places(world) == AS_CORNERS
    world.ports["Simulation"].reset()
    assert set(visible_places(world).values()) == {(False, True, False)}


@pytest.mark.parametrize(
    ("width", "height", "depth", "count", "message"),
    [
        (0, 0, 3, 0, "no image"),
        (2, 2, 2, 8, "no image"),
        (2, 2, 3, 11, "not 11"),
        (-1, -1, 3, 3, "no"),
    ],
)
def test_display_servant_refuses_invalid_images(
    world: Served, width: int, height: int, depth: int, count: int, message: str
) -> None:
    image = world.types.Image(width, height, depth, np.zeros(count, np.uint8))
    with pytest.raises(Exception, match=message) as raised:
        world.ports["face"].setImage(image)
    assert type(raised.value).__name__.endswith("HardwareFailedException")


@pytest.mark.parametrize(
    ("name", "message"), [("gone.png", "No such file"), ("text.png", "no picture")]
)
def test_display_servant_refuses_files_without_image(
    world: Served, tmp_path: Path, name: str, message: str
) -> None:
    (tmp_path / "text.png").write_text("text")
    with pytest.raises(Exception, match=message):
        world.ports["face"].setImageFromFile(str(tmp_path / name))

"""The picture of the touch demo, from recordings; with photographs, and where none can be made."""

import numpy as np
import pytest
from matplotlib.image import imread

from robocomp_dsl.hardware.devices.errors import NoRendering
from robocomp_dsl.simulation.view.offscreen import egl_trouble, osmesa_trouble
from tests.demo.touch_demo_samples import demo, part, recording, skin, world

WIDE = 1600


@pytest.fixture(scope="module")
def body(tmp_path_factory: pytest.TempPathFactory) -> object:
    return demo().body.Body(world(tmp_path_factory.mktemp("body")), skin(), part())


def column(body, photos, why_not="", **changes):
    it = recording(**changes)
    found = demo().metrics.outcomes(it, body)
    return demo().panel.Column(it, found, found[0], photos, why_not)


def like(picture: np.ndarray, colour) -> np.ndarray:
    return (np.abs(picture[:, :, :3] - np.array(colour)[:3]) < 0.02).all(axis=2)


def test_photograph_colours_taxels_by_force(body, tmp_path) -> None:
    photos = tuple(np.full((608, 694, 3), value, dtype=np.uint8) for value in (90, 160))
    demo().figure.draw(
        [column(body, photos), column(body, photos, name="iCub")], "A title", "facts", 1.0,
        tmp_path / "a.png",
    )  # fmt: skip
    picture = imread(tmp_path / "a.png")
    assert picture.shape[1] == WIDE
    assert 1200 < picture.shape[0] < 2400
    felt, untouched = demo().colours.pressure(np.array([0.5, 0.0]), 1.0)
    # 4 taxels of 2 touches on 2 robots, all of 0.5 N
    assert 8000 > like(picture, felt).sum() > 16 * 40
    assert like(picture, untouched).sum() > 20 * like(picture, felt).sum()
    for value in (90, 160):
        assert like(picture, np.full(3, value / 255)).sum() > 0.8 * 2 * 340 * 300
    lines = [like(picture, rgb(taxel)).sum() for taxel in demo().colours.JOINTS[:4]]
    assert min(lines) > 300


def rgb(code: str) -> tuple[float, ...]:
    return tuple(int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))


def test_touch_picture_without_photographs_says_why(body, tmp_path) -> None:
    columns = [column(body, None, "this machine has no OpenGL")]
    demo().figure.draw(columns, "A title", "facts", 1.0, tmp_path / "a.png")
    photos = tuple(np.full((608, 694, 3), 90, dtype=np.uint8) for _ in range(2))
    demo().figure.draw([column(body, photos)], "A title", "facts", 1.0, tmp_path / "b.png")
    bare, with_photos = (imread(tmp_path / name) for name in ("a.png", "b.png"))
    assert bare.shape == with_photos.shape
    assert like(bare, [90 / 255] * 3).sum() < 2000 < like(with_photos, [90 / 255] * 3).sum()


@pytest.mark.skipif(bool(egl_trouble() and osmesa_trouble()), reason="needs libegl1 or libosmesa6")
def test_touch_picture_shows_touched_skin_and_withdrawn_arm(body) -> None:
    it = recording(force=1.0)
    first, _ = demo().metrics.outcomes(it, body)
    before, after = demo().photograph.before_and_after(it, body, first, 1.0, (320, 280))
    assert before.shape == after.shape == (280, 320, 3)

    def reddish(pixels: np.ndarray) -> int:
        red, green, blue = (pixels[:, :, i].astype(int) for i in range(3))
        return int(((red + green - 2 * blue > 60) | (red - blue > 60)).sum())

    assert reddish(after) == 0
    assert 20 < reddish(before) < 2000
    assert (np.abs(before.astype(int) - after).max(axis=2) > 40).mean() > 0.02


def test_touch_picture_selects_successful_touch(body) -> None:
    it = recording(answers=recording().answers[2:])  # nothing answered the first
    found = demo().metrics.outcomes(it, body)
    assert found[0].trouble
    assert demo().photograph.best_seen(it, body, found) is found[1]


def test_touch_picture_reports_missing_drawing_library(body, monkeypatch) -> None:
    def nothing(*_: object) -> None:
        raise NoRendering("offscreen rendering is not available: none")

    monkeypatch.setattr(demo().photograph, "Renderer", nothing)
    it = recording()
    first, _ = demo().metrics.outcomes(it, body)
    with pytest.raises(NoRendering, match="offscreen rendering is not available"):
        demo().photograph.before_and_after(it, body, first, 1.0, (320, 280))

"""`rcgen view`: pictures of worlds and robots, and findings about invalid ones."""

import importlib
import struct
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.simulation.view import offscreen
from robocomp_dsl.simulation.view.picture import Renderer, Viewpoint, png
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.cli.rcgen_run import Rcgen
from tests.cli.view_run import view
from tests.simulation.served_worlds import scene_of

MODELS = Path(__file__).parents[1] / "simulation" / "models" / "files"


def pixels(path: Path) -> np.ndarray:
    """The pixels of a PNG file of the renderer."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", data[16:24])
    packed, at = b"", 8
    while at < len(data):
        (size,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        assert struct.unpack_from(">I", data, at + 8 + size)[0] == zlib.crc32(kind + body)
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    return lines[:, 1:].reshape(height, width, 3)


SUBJECTS = ["nao_h21", "nao_h25", "icub_v2", *(MODELS / n for n in ("arm.urdf", "crane.xml"))]


@pytest.mark.parametrize(
    "subject", [*SUBJECTS, MODELS / "room.xml"], ids=lambda subject_: Path(subject_).stem
)
def test_view_screenshot_is_centred(rcgen: Rcgen, tmp_path: Path, subject: object) -> None:
    path = tmp_path / "picture.png"
    result = rcgen("view", str(subject), "--screenshot", str(path), "--size", "320x240")
    assert result.code == 0, result.err
    assert "320 x 240 pixels" in result.out
    image = pixels(path).astype(int)
    assert image.shape == (240, 320, 3)
    sky = image[:, :8].mean(axis=1, keepdims=True)  # it shades from top to bottom only
    other = np.abs(image - sky).max(axis=2) > 25
    assert other[60:180, 80:240].mean() > 0.05
    assert 0.01 < other.mean() < 0.9
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("more", ["--frames", "--names", "--azimuth=200", "--zoom=2"])
def test_view_screenshot_options(rcgen: Rcgen, tmp_path: Path, more: str) -> None:
    pictures = []
    for name, options in (("a", ()), ("b", (more,))):
        path = tmp_path / f"{name}.png"
        run = rcgen("view", "nao_h25", "--screenshot", str(path), "--size", "160x120", *options)
        assert run.code == 0
        pictures.append(pixels(path))
    assert (pictures[0] != pictures[1]).any(axis=2).mean() > 0.003


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot>\n<link name='a'/>\n<link name='a'/></robot>", ":3:1"),
        ("<robot>\n<link name='a'/>\n<link name='a'/></robot>", "RC651]: there are two links `a`"),
        ("<mujoco>\n  <geom/></mujoco>", ":2:3"),
        ("<innerModl>\n<transform id='a'/></innerModl>", "did you mean `innerModel`?"),
        ("", "RC"),
    ],
)
def test_view_reports_invalid_model_with_location(
    rcgen: Rcgen, tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "model.xml"
    path.write_text(text)
    result = rcgen("view", str(path), "--screenshot", str(tmp_path / "no.png"))
    assert result.code == 1
    assert message in result.err
    assert "Traceback" not in result.err
    assert not (tmp_path / "no.png").exists()


def test_view_shows_valid_part_of_world(rcgen: Rcgen, tmp_path: Path) -> None:
    path = tmp_path / "world.xml"
    path.write_text(
        '<innerModel><plane id="a" texture="#ff0000"/><plane id="a" px="9"/><nix/></innerModel>'
    )
    result = rcgen("view", str(path), "--screenshot", str(tmp_path / "w.png"), "--size", "64x48")
    assert result.code == 0
    assert "the id `a` is not unique" in result.err
    assert pixels(tmp_path / "w.png").shape == (48, 64, 3)


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (("gone.xml",), 1, "`gone.xml` cannot be read: No such file"),
        (("nao_h25", "--screenshot", "gone/a.png"), 1, "No such file or directory"),
        (("nao_h25", "--screenshot", "a.png", "--size", "0x5"), 1, "1 to 8192 pixels a side"),
        (("nao_h25", "--screenshot", "a.png", "--size", "big"), 2, "as in 1280x960"),
        (("nao_h25", "--screenshot", "a.png", "--camera", "x"), 1, "the model has no camera `x`"),
    ],
)
def test_view_usage_errors(
    rcgen: Rcgen,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    code: int,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    result = rcgen("view", *arguments)
    assert (result.code, message in result.err) == (code, True), result.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("libraries", "chosen", "message"),
    [
        ((), "", "apt install libegl1 libgl1-mesa-dri; `libOSMesa.so.8` is missing: apt install"),
        ((), "osmesa", "not available: `libOSMesa.so.8` is missing: apt install libosmesa6"),
        (("libEGL.so.1",), "egl", "EGL has no rendering device: apt install libgl1-mesa-dri"),
    ],
)
def test_view_names_missing_package(
    monkeypatch: pytest.MonkeyPatch, libraries: tuple[str, ...], chosen: str, message: str
) -> None:
    def library(name: str) -> object:
        return object() if name in libraries else None

    monkeypatch.setattr(offscreen, "_library", library)
    monkeypatch.setattr(offscreen, "_any_device", lambda _: False)
    monkeypatch.setenv(offscreen.CHOSEN, chosen)
    with pytest.raises(offscreen.NoRendering) as error:
        offscreen.new_context(64, 48)
    assert message in str(error.value)


def test_png_of_known_pixels(tmp_path: Path) -> None:
    image = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    (tmp_path / "a.png").write_bytes(png(image))
    assert (pixels(tmp_path / "a.png") == image).all()


def test_renderer_orientation() -> None:
    import mujoco  # noqa: PLC0415

    text = "<mujoco><worldbody><geom size='.2' pos='0 0 1' rgba='1 0 0 1'/>"
    text += "<geom size='.2' pos='0 0 -1' rgba='0 0 1 1'/></worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Renderer(model, 64, 64) as renderer:
        image = renderer.render(data, Viewpoint(elevation=0)).astype(int)
    assert image[:32, :, 0].sum() > 10 * image[32:, :, 0].sum() + 1000
    assert image[32:, :, 2].sum() > image[:32, :, 2].sum()


def test_renderer_draws_all_sites() -> None:
    import mujoco  # noqa: PLC0415

    dots = "<site size='.01' rgba='0 0 1 1'/>" * 3000
    text = "<mujoco><worldbody><geom size='.2' rgba='0 0 1 1'/>" + dots
    text += "<site size='.2' pos='0 0 .3' rgba='1 0 0 1'/></worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Renderer(model, 64, 64) as renderer:
        image = renderer.render(data, Viewpoint(elevation=0, distance=3)).astype(int)
    assert ((image[:, :, 0] > 150) & (image[:, :, 2] < 80)).any()


def test_view_reports_overlapping_bodies_with_location(rcgen: Rcgen, tmp_path: Path) -> None:
    cup = (
        '<transform id="{0}" ty="{1}" engine="bullet" mass="1"><plane id="{0}_p" size="100,100,100"'
    )
    cup += ' collide="1"/></transform>\n'
    path = tmp_path / "world.xml"
    path.write_text("<innerModel>\n" + cup.format("a", 0) + cup.format("b", 80) + "</innerModel>")
    result = rcgen("view", str(path), "--screenshot", str(tmp_path / "w.png"), "--size", "64x48")
    assert result.code == 0
    assert "RC653]: `a` and `b` overlap by 20 mm" in result.err
    assert "world.xml:2:1" in result.err


def test_view_of_empty_world(tmp_path: Path) -> None:
    """In a process, so that output of libraries is captured, too."""
    path = tmp_path / "world.xml"
    path.write_text("<innerModel/>")
    result = view(str(path), "--screenshot", str(tmp_path / "w.png"), "--size", "64x48")
    assert (result.code, result.err) == (0, "")


def test_view_names_missing_browser_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    monkeypatch.delitem(sys.modules, "robocomp_dsl.simulation.view.browser", raising=False)
    with pytest.raises(ImportError, match=r"pip install 'robocomp_dsl\[view\]'"):
        importlib.import_module("robocomp_dsl.simulation.view.browser")


def test_view_reports_overlapping_links_with_location(rcgen: Rcgen, tmp_path: Path) -> None:
    ball = "<body name='{}'><freejoint/><geom size='.1'/></body>\n"
    path = tmp_path / "balls.xml"
    balls = ball.format("a") + ball.format("b")
    path.write_text(f"<mujoco><worldbody>\n{balls}</worldbody></mujoco>")
    result = rcgen("view", str(path), "--screenshot", str(tmp_path / "w.png"), "--size", "64x48")
    assert result.code == 0
    assert "`a` and `b` overlap by 200 mm" in result.err
    assert "balls.xml:2:1" in result.err


CAMERA_WORLD = """\
<innerModel>
  <transform id="world">
    <plane id="left" nz="-1" px="-800" pz="3000" size="500,1000,500" texture="#ff0000"/>
    <plane id="right" nz="-1" px="800" pz="3000" size="500,600,500" texture="#00ff00"/>
    <plane id="behind" nz="-1" pz="-3000" size="900,1000,500" texture="#0000ff"/>
    <differentialrobot id="robot">
      <camera id="eye" width="160" height="120" focal="130"/>
      <transform id="back" ry="180 deg">
        <rgbd id="rear" width="128" height="64" focal="60"/>
      </transform>
    </differentialrobot>
  </transform>
</innerModel>
"""


@pytest.fixture
def camera_world(tmp_path: Path) -> Path:
    path = tmp_path / "world.xml"
    path.write_text(CAMERA_WORLD)
    return path


def test_view_camera_of_innermodel_shows_what_it_looks_at(
    rcgen: Rcgen, tmp_path: Path, camera_world: Path
) -> None:
    """Red on the left, green on the right; blue behind the robot. The size is the camera's."""
    path = tmp_path / "picture.png"
    seen = {}
    for name, size in (("eye", "160 x 120"), ("rear", "128 x 64")):
        result = rcgen("view", str(camera_world), "--camera", name, "--screenshot", str(path))
        assert result.code == 0, result.err
        assert f"{size} pixels" in result.out
        image = pixels(path).astype(int)
        pure = [image[..., i] - np.delete(image, i, axis=2).max(axis=2) > 100 for i in range(3)]
        columns = np.arange(image.shape[1]) / image.shape[1]
        seen[name] = [
            float(columns[mask.any(axis=0)].mean()) if mask.mean() > 0.01 else None for mask in pure
        ]
    left, right, nothing = seen["eye"]
    assert left is not None
    assert right is not None
    assert left < 0.4 < 0.6 < right
    assert nothing is None
    assert seen["rear"] == [None, None, pytest.approx(0.5, abs=0.02)]


def test_view_camera_shows_picture_of_simulated_camera(
    rcgen: Rcgen, tmp_path: Path, camera_world: Path
) -> None:
    """What `CameraSimple` of the simulator serves, pixel by pixel."""
    path = tmp_path / "picture.png"
    scene = scene_of(camera_world, CAMERA_WORLD)
    simulation = Simulation(scene)
    try:
        for name in ("eye", "rear"):
            rcgen("view", str(camera_world), "--camera", name, "--screenshot", str(path))
            assert (pixels(path) == simulation.devices[name].picture().colour).all()
    finally:
        simulation.stop()


@pytest.mark.parametrize("page", [False, True], ids=["screenshot", "page"])
def test_view_lists_cameras_if_the_name_is_unknown(
    rcgen: Rcgen, tmp_path: Path, camera_world: Path, page: bool
) -> None:
    to = ("--port", "0", "--no-browser") if page else ("--screenshot", str(tmp_path / "a.png"))
    result = rcgen("view", str(camera_world), "--camera", "ear", *to)
    assert result.code == 1
    expected = "the model has no camera `ear`: its cameras are `eye`, `rear`"
    assert expected in result.err


def test_view_camera_of_mjcf_has_default_size(rcgen: Rcgen, tmp_path: Path) -> None:
    text = """<mujoco><worldbody><geom type="box" size=".1 .1 .1"/>
      <camera name="side" pos="0 -1 0" euler="90 0 0"/>
      <camera name="small" pos="0 -1 0" euler="90 0 0" resolution="80 60"/>
    </worldbody></mujoco>"""
    (tmp_path / "m.xml").write_text(text)
    for name, shape in (("side", (960, 1280, 3)), ("small", (60, 80, 3))):
        to = str(tmp_path / "m.png")
        result = rcgen("view", str(tmp_path / "m.xml"), "--camera", name, "--screenshot", to)
        assert result.code == 0, result.err
        assert pixels(tmp_path / "m.png").shape == shape

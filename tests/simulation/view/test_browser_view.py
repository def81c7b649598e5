"""The view in the browser: what its controls do, and a real browser that looks at it."""

import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import closing
from functools import partial
from pathlib import Path

import mujoco
import numpy as np
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

from robocomp_dsl.hardware.devices.errors import NoRendering
from robocomp_dsl.simulation.models.model_file import load_model
from robocomp_dsl.simulation.view.browser import LOOPBACK, BrowserPage
from robocomp_dsl.simulation.view.nodes import quaternion, roll_pitch_yaw, tree
from robocomp_dsl.simulation.view.picture import Viewpoint
from robocomp_dsl.simulation.view.shapes import colour, triangles
from robocomp_dsl.simulation.view.stage import relative_poses
from robocomp_dsl.simulation.world.visual_state import capture
from tests.support.chromium_tab import URL_LINE, Tab, needs_chromium, opened_tab, red
from tests.support.waiting import TIMEOUT_S, wait_until

MODELS = Path(__file__).parents[1] / "models" / "files"


@pytest.fixture
def page() -> Iterator[BrowserPage]:
    model = load_model(MODELS / "crane.xml").model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    result = BrowserPage("crane", model, data)
    yield result
    result.close()


def test_browser_view_listens_on_loopback_only(page: BrowserPage) -> None:
    assert page.url.startswith(f"http://{LOOPBACK}:")
    with urllib.request.urlopen(page.url, timeout=TIMEOUT_S) as answer:
        assert b"<html" in answer.read(2000).lower()
    port = page.port
    listening = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
    mine = [line.split()[1] for line in listening.splitlines() if f":{port:04X} " in line]
    assert mine
    assert all(
        address.startswith("0100007F") for address in mine if address.endswith(f"{port:04X}")
    )
    assert page._server.request_share_url() is None


def test_browser_view_reports_occupied_port() -> None:
    model = load_model(MODELS / "crane.xml").model
    with socket.socket() as other:
        other.bind((LOOPBACK, 0))
        other.listen()
        with pytest.raises(OSError, match="in use"):
            BrowserPage("crane", model, mujoco.MjData(model), port=other.getsockname()[1])


def test_browser_view_shows_markers_of_missing_meshes(tmp_path: Path) -> None:
    file = tmp_path / "a.xml"
    file.write_text(
        "<mujoco><asset><mesh name='m' file='gone.obj'/></asset><worldbody><body name='b'>"
        "<geom type='mesh' mesh='m' pos='1 2 3'/></body></worldbody></mujoco>"
    )
    model = load_model(file).model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    page = BrowserPage("a", model, data)
    try:
        markers = [name for name in page._server.scene._handle_from_node_name if "missing" in name]
        assert markers == ["/world/b/gone.obj 1:missing mesh"]
        handle = page._server.scene._handle_from_node_name[markers[0]]
        assert handle.position.tolist() == [1, 2, 3]
        assert max(handle.dimensions) <= 0.03 * page.stage.extent
    finally:
        page.close()


def test_browser_view_nodes_follow_model_hierarchy(page: BrowserPage) -> None:
    assert page.stage.paths == [
        "/world",
        "/world/tower",
        "/world/tower/boom",
        "/world/tower/boom/load",
        "/world/crate",
    ]
    page.data.joint("turn").qpos = 1.0
    mujoco.mj_forward(page.model, page.data)
    page.refresh()
    poses = relative_poses(page.model, capture(page.model, page.data).poses)
    for body, handle in enumerate(page.stage.frames, 1):
        assert handle.position == pytest.approx(poses[body, :3], abs=1e-6)
        assert handle.wxyz == pytest.approx(poses[body, 3:], abs=1e-6)
    slider = page.controls._sliders[0][0]
    assert slider.value == pytest.approx(1.0, abs=1e-3)


def test_browser_view_relative_poses_give_absolute_poses(page: BrowserPage) -> None:
    model, data = page.model, page.data
    poses = relative_poses(model, capture(model, data).poses)
    for body in range(1, model.nbody):
        above = model.body_parentid[body]
        turn, quat = np.zeros(9), np.zeros(4)
        mujoco.mju_quat2Mat(turn, poses[body, 3:])
        mujoco.mju_mulQuat(quat, data.xquat[above], poses[body, 3:])
        there = data.xmat[above].reshape(3, 3) @ poses[body, :3] + data.xpos[above]
        assert there == pytest.approx(data.xpos[body], abs=1e-12)
        mujoco.mju_quat2Mat(turn, quat)
        assert turn == pytest.approx(data.xmat[body], abs=1e-12)


def move_handle(page: BrowserPage, handle: object, value: object) -> None:
    """As when it is moved in the browser."""
    handle.value = value  # type: ignore[attr-defined]  # viser calls what listens, from here too


def test_browser_view_sliders_move_joints_and_button_resets_them(page: BrowserPage) -> None:
    labels = [slider.label for slider, _ in page.controls._sliders]
    assert labels == ["turn [rad]", "raise [rad]", "extend [m]"]
    slider, address = page.controls._sliders[2]
    assert (slider.min, slider.max) == (0.0, 0.5)
    move_handle(page, slider, 0.25)
    wait_until(lambda: abs(page.data.qpos[address] - 0.25) < 1e-9)
    page.controls.reset()
    assert page.data.qpos[address] == 0.0
    assert slider.value == pytest.approx(0.0)


def test_browser_view_moves_node(page: BrowserPage) -> None:
    for name in ("tower", "crate"):
        body = page.model.body(name).id
        page.controls.place(body, np.array([0.5, 0.25, 1.0]), quaternion((0, 0, 1.5)))
        assert page.data.xpos[body] == pytest.approx([0.5, 0.25, 1.0], abs=1e-9)
        assert page.stage.frames[body - 1].position == pytest.approx([0.5, 0.25, 1.0])


def test_browser_view_time_runs_on_request(page: BrowserPage) -> None:
    crate = page.model.body("crate").id
    height = page.data.xpos[crate, 2]
    end = time.monotonic() + TIMEOUT_S
    page.controls.running = True
    page.run(lambda: page.data.time < 0.5 and time.monotonic() < end)
    assert page.data.xpos[crate, 2] < height - 0.05
    page.stage.show_contacts(on=True)
    assert page.stage._contacts is not None
    page.stage.show_contacts(on=False)
    assert page.stage._contacts is None


@pytest.mark.parametrize("turn", [(0.1, -0.5, 2.0), (3.0, 1.5, -3.0), (0, 0, 0)])
def test_browser_view_roll_pitch_yaw_round_trip(turn: tuple[float, ...]) -> None:
    quat = quaternion(turn)
    assert quaternion(roll_pitch_yaw(quat)) * np.sign(quat[0]) == pytest.approx(
        quat * np.sign(quat[0]), abs=1e-9
    ) or quaternion(roll_pitch_yaw(quat)) == pytest.approx(-quat, abs=1e-9)


def test_browser_view_tree_has_text_form() -> None:
    text = "<mujoco><worldbody><body name='a'><body name='&lt;b&gt;'><joint/><geom size='1'/>"
    model = mujoco.MjModel.from_xml_string(text + "</body></body><body/></worldbody></mujoco>")
    names = [model.body(i).name or f"body{i}" for i in range(model.nbody)]
    assert tree(model, names) == "- a (fixed)\n  - &lt;b&gt; (hinge)\n- body3 (fixed)"


KINDS = {
    "sphere": ("size='.2'", (0.2, 0.2, 0.2)),
    "box": ("size='.1 .2 .3'", (0.1, 0.2, 0.3)),
    "capsule": ("size='.1 .2'", (0.1, 0.1, 0.3)),
    "cylinder": ("size='.1 .2'", (0.1, 0.1, 0.2)),
    "ellipsoid": ("size='.1 .2 .3'", (0.1, 0.2, 0.3)),
    "plane": ("size='1 2 .1'", (1, 2, 0.001)),
    "mesh": ("mesh='m'", None),
    "hfield": ("hfield='h'", None),
}


@pytest.mark.parametrize("kind", list(KINDS))
def test_browser_view_shapes_have_size_and_outward_normals(kind: str) -> None:
    written, half = KINDS[kind]
    text = f"<mujoco><asset><mesh name='m' file='{MODELS}/meshes/pyramid.obj'/><hfield name='h' "
    text += "nrow='3' ncol='4' size='2 1 .5 .1' elevation='0 1 2 3 4 5 6 7 8 9 10 11'/></asset>"
    text += f"<worldbody><geom type='{kind}' {written} rgba='1 0.5 0 0.5'/></worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    result = triangles(model, 0)
    assert result is not None
    extent = (result.points.max(axis=0) - result.points.min(axis=0)) / 2
    assert extent == pytest.approx(half or extent, abs=2e-3)
    a, b, c = (result.points[result.faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    if kind == "hfield":
        assert (normal[:, 2] > 0).all()
        assert extent == pytest.approx([2, 1, 0.25])
    else:
        volume = np.einsum("ij,ij->i", a, normal).sum() / 6
        assert volume > 0
    assert colour(model, 0) == (255, 127, 0, pytest.approx(0.5))


# -- a real browser ------------------------------------------------------------------------------


@pytest.fixture
def tab() -> Iterator[Tab]:
    with opened_tab() as result:
        yield result


@needs_chromium
def test_browser_view_renders_scene_in_browser_without_other_requests(tab: Tab) -> None:
    start = "from robocomp_dsl.cli.rcgen.main import main; main()"
    arguments = ["view", str(MODELS / "arm.urdf"), "--port", "0", "--names"]
    with subprocess.Popen(
        [sys.executable, "-c", start, *arguments], stdout=subprocess.PIPE, text=True
    ) as served:
        try:
            assert served.stdout
            received = re.match(URL_LINE, served.stdout.readline())
            assert received
            tab("Network.enable")
            tab("Page.enable")
            tab("Page.navigate", url=received[1])
            wait_until(lambda: tab.shows("Frames", "Let time run"))
            wait_until(lambda: red(tab.picture()) > 0.001)  # the shoulder of the arm
            for name, words in (
                ("Joints", ("lift [rad]", "reach [m]")),
                ("Nodes", ("place [m]", "left_finger (slide)")),
            ):
                tab.open_panel(name)
                wait_until(partial(tab.shows, *words))
            elsewhere = [
                url
                for url in tab.asked
                if not re.match(rf"(blob:)?(http|ws)://{re.escape(LOOPBACK)}:|data:|about:", url)
            ]
            assert elsewhere == []
            assert any(url.startswith(received[1]) for url in tab.asked)
        finally:
            served.send_signal(signal.SIGINT)
        assert served.wait(TIMEOUT_S) == 130


def test_browser_view_starts_at_camera_of_model() -> None:
    """It looks along -z of MuJoCo's camera: here from the south to the north."""
    text = """<mujoco><worldbody><geom size=".1"/><body pos="0 -1 0.5">
      <camera name="side" euler="90 0 0" fovy="40"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with closing(BrowserPage("m", model, data, Viewpoint(camera="side"))) as shown:
        camera = shown._server.initial_camera
        assert camera.position == pytest.approx((0, -1, 0.5))
        assert camera.look_at == pytest.approx((0, 0, 0.5), abs=1e-6)
        assert camera.up == pytest.approx((0, 0, 1), abs=1e-6)
        assert camera.fov == pytest.approx(np.deg2rad(40))
    with pytest.raises(NoRendering, match="its cameras are `side`"):
        BrowserPage("m", model, data, Viewpoint(camera="top"))

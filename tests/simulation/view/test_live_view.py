"""The live view: a page that follows a running simulation and holds its time."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.simulation.view.live import LivePage
from robocomp_dsl.simulation.view.nodes import quaternion
from robocomp_dsl.simulation.view.running import UnsupportedSimulation, fetch_live_state
from robocomp_dsl.simulation.world import visual_state
from tests.simulation.served_worlds import CLIENT, Served, rcgen, run, served
from tests.support.chromium_tab import (
    PATIENCE,
    URL_LINE,
    needs_chromium,
    opened_tab,
    red,
    wait_for,
)

WORLD = """\
<innerModel>
 <transform id="floor"/>
 <plane id="ground" ny="1" size="4000,4000,50" py="-25" texture="#606060"/>
 <differentialrobot id="robot" tx="-1000">
  <plane id="hull" nz="-1" py="500" size="900,900,900" texture="#ff0000"/>
  <joint id="neck" axis="y" min="-1" max="1" ty="900"/>
 </differentialrobot>
</innerModel>
"""


class Hand:
    """The proxy of a port of a world in this process; `gone` as long as nobody serves it."""

    def __init__(self, world: Served, port: str = "Simulation") -> None:
        self.world, self.gone, self.port = world, False, port
        self.set_timeout: Callable[[float], None] = lambda seconds: None

    def __getattr__(self, operation: str) -> Any:
        if self.gone:
            raise NoServer("nobody is there")
        return getattr(self.world.ports[self.port], operation)


@pytest.fixture
def live(tmp_path: Path) -> Iterator[LivePage]:
    hand: Any = Hand(served(tmp_path, WORLD))
    nodes: Any = Hand(hand.world, "InnerModelManager")
    result = LivePage("sim", hand, nodes=nodes)
    result.hand = hand  # type: ignore[attr-defined]
    yield result
    result.close()


def world_of(live: LivePage) -> Served:
    found: Served = live.hand.world  # type: ignore[attr-defined]
    return found


def text(live: LivePage) -> str:
    message: str = live.page.controls._status.content
    return message


def test_it_is_where_the_world_is(live: LivePage) -> None:
    world = world_of(live)
    world.ports["robot"].setSpeedBase(400.0, 0.5)
    goal = SimpleNamespace(name="neck", position=0.5, maxSpeed=1.0)
    world.ports["JointMotor"].setPosition(goal)
    world.simulation.advance(1.0)
    live.refresh()
    place = live.page.stage.frames[live.page.model.body("robot").id - 1].position
    pose = world.ports["Simulation"].getPoses(0, ["robot"])[0]
    assert place[:2] * 1000 == pytest.approx([pose.x, pose.z], abs=0.1)
    assert pose.z > 200
    slider = next(s for s, _ in live.page.controls._sliders if s.label == "neck [rad]")
    assert slider.value == pytest.approx(0.5, abs=0.01)
    assert text(live) == "simulated time 1.00 s, 0.00 times real time"


def test_its_switches_hold_the_time(live: LivePage) -> None:
    world, controls = world_of(live), live.page.controls
    assert controls._time.value
    controls._time.value = False  # as in the browser
    assert world.simulation.step_driver.paused
    live.refresh()
    assert text(live).endswith("paused")
    world.ports["Simulation"].step(50)
    world.ports["Simulation"].resume()
    live.refresh()
    assert controls._time.value, "somebody else has let it go on"
    assert not world.simulation.step_driver.paused
    controls.reset()
    assert world.simulation.time == 0


def test_a_step_and_another_speed(live: LivePage) -> None:
    world, far = world_of(live), live.page.controls._remote
    assert far
    for n in (1, 2):
        far.step(0.01)
        live.refresh()
        assert text(live) == f"simulated time {n * 0.01:.2f} s, paused"
    assert far.speed() == 1.0
    far.set_speed(3.0)
    assert world.simulation.step_driver.speed == far.speed() == 3.0
    far.set_speed(-1.0)
    live.refresh()
    assert "the command failed: `speed` is -1, it cannot be negative" in text(live)


def test_a_slider_moves_a_joint_of_the_world(live: LivePage) -> None:
    world, controls = world_of(live), live.page.controls
    slider, address = next(item for item in controls._sliders if item[0].label == "neck [rad]")
    slider.value = 0.8  # as in the browser
    world.simulation.advance(0.02)
    live.refresh()
    assert slider.value == 0.8, "it stays under the hand"
    world.until(lambda: abs(world.ports["Simulation"].getJoints(0, ["neck"])[0] - 0.8) < 0.01)
    slider.value = 0.2
    world.until(lambda: world.ports["Simulation"].getJoints(0, ["neck"])[0] < 0.21)
    controls._touched.clear()  # its second is over
    live.refresh()
    assert slider.value == pytest.approx(0.2, abs=0.02)
    assert live.page.data.qpos[address] == pytest.approx(0.2, abs=0.02)


def test_a_node_is_placed_in_the_world(live: LivePage) -> None:
    world, page = world_of(live), live.page
    live.refresh()
    quat = quaternion((0.0, 0.0, 0.5))
    page.controls.place(page.model.body("robot").id, np.array([0.25, -0.5, 0.125]), quat)
    pose = world.ports["Simulation"].getPoses(0, ["robot"])[0]
    assert (pose.x, pose.y, pose.z) == pytest.approx((250, 125, -500))
    live.refresh()
    assert page.stage.relative[page.model.body("robot").id, 3:] == pytest.approx(quat, abs=1e-6)


def test_what_cannot_be_is_said(live: LivePage) -> None:
    far = live.page.controls._remote
    assert far
    far.move("nobody", 1.0, turns=True)
    live.refresh()
    assert text(live).endswith("the command failed: there is no joint `nobody`")
    far.place("nobody", np.zeros(3), np.array([1.0, 0, 0, 0]))
    live.refresh()
    assert "the command failed" in text(live)
    assert "`nobody`" in text(live)
    far.reset()
    live.refresh()
    assert "work out" not in text(live)


def test_a_node_that_comes_is_on_the_page(live: LivePage) -> None:
    world = world_of(live)
    before = live.page.stage.paths
    plane = world.types.Plane3D(500.0, 140.0, 900, 0.0, 0.0, -1.0, 400.0, 400.0, 2.0)
    nodes = world.ports["InnerModelManager"]
    nodes.addTransform("mark", "", "robot", world.types.Pose3D(1, 2, 3, 0, 0, 0))
    nodes.addPlane("crate", "mark", plane)
    live.refresh()
    assert set(live.page.stage.paths) == {*before, "/world/robot/mark"}
    nodes.removeNode("mark")
    live.refresh()
    assert live.page.stage.paths == before


def test_a_simulation_that_ends_is_told_and_comes_back(live: LivePage, tmp_path: Path) -> None:
    hand: Any = live.hand  # type: ignore[attr-defined]
    hand.gone = True
    live.refresh()
    assert text(live) == "**sim does not answer**"
    hand.gone, hand.world = False, served(tmp_path, WORLD.replace("neck", "head"))
    live.refresh()
    assert "simulated time 0.00 s" in text(live)
    assert "/world/robot/head" in live.page.stage.paths


def test_another_mujoco_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world = served(tmp_path, WORLD)
    monkeypatch.setattr(visual_state, "VERSION", "1.2.3")
    hand: Any = Hand(world)
    with pytest.raises(UnsupportedSimulation, match=r"1\.2\.3"):
        fetch_live_state(hand)


def test_points_move_with_their_body(live: LivePage) -> None:
    points = np.array([[0.0, 0.0, 0.5], [0.1, 0.0, 0.5]])
    colours = np.array([[255, 0, 0], [0, 255, 0]], np.uint8)
    live.page.show_points("skin", "robot", points, colours)
    (cloud,) = live.page.stage._clouds.values()
    assert cloud.name == "/world/robot/skin:points"
    live.page.show_points("skin", "robot", points, colours[::-1])
    assert live.page.stage._clouds == {cloud.name: cloud}
    assert cloud.colors.tolist() == colours[::-1].tolist()
    live.page.show_points("skin", "robot", points[:1], colours[:1])
    assert len(live.page.stage._clouds[cloud.name].points) == 1
    world = world_of(live)
    mark = world.types.Pose3D(1, 2, 3, 0, 0, 0)
    world.ports["InnerModelManager"].addTransform("mark", "", "floor", mark)
    live.refresh()
    assert "/world/floor/mark" in live.page.stage.paths
    assert list(live.page.stage._clouds) == [cloud.name], "in the new model, too"
    with pytest.raises(KeyError):
        live.page.show_points("skin", "nobody", points, colours)


# -- the command, and a real browser -------------------------------------------------------------


@contextmanager
def command(*arguments: str, cwd: Path) -> Iterator[subprocess.Popen[str]]:
    """A program that is ended with Ctrl-C, whatever happens."""
    process = subprocess.Popen(
        arguments, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(PATIENCE)
        finally:
            process.kill()


VIEW = [
    sys.executable,
    "-c",
    "from robocomp_dsl.cli.rcgen.main import main; main()",
    "view",
    "--live",
]


@pytest.fixture(scope="module")
def simulator(tmp_path_factory: pytest.TempPathFactory) -> Path:
    home = tmp_path_factory.mktemp("live")
    (home / "room.xml").write_text(WORLD)
    done = rcgen("simulator", "room.xml", cwd=home)
    assert done.returncode == 0, done.stderr
    return home / "room_simulator"


def middle(picture: np.ndarray) -> float:
    """Where the red of a picture is, from left to right."""
    seen = (picture[:, :, 0] > 0.6) & (picture[:, :, 1:].max(axis=2) < 0.35)
    return float(np.flatnonzero(seen.any(axis=0)).mean())


@needs_chromium
def test_a_real_browser_sees_a_robot_drive(simulator: Path) -> None:
    domain = f"live-{os.getpid()}"
    main = [sys.executable, "main.py", "--domain", domain]
    with command(*main, cwd=simulator), opened_tab() as tab:
        options = ["room_simulator", "--domain", domain, "--port", "0"]
        with command(*VIEW, *options, cwd=simulator) as view:
            assert view.stdout
            received = re.match(URL_LINE, view.stdout.readline())
            assert received
            tab("Page.enable")
            screen = {"width": 600, "height": 400, "deviceScaleFactor": 1, "mobile": False}
            tab("Emulation.setDeviceMetricsOverride", **screen)
            tab("Page.navigate", url=received[1])
            wait_for(lambda: tab.shows("Let time run", "simulated time"))
            wait_for(lambda: red(tab.picture()) > 0.003)
            before = middle(tab.picture())
            run(simulator, CLIENT + DRIVE, "zenoh", domain, "room_simulator")
            wait_for(lambda: abs(middle(tab.picture()) - before) > 30)
            told_time = lambda: re.search(  # noqa: E731
                r"simulated time ([\d.]+) s", str(tab.value("document.body.innerText"))
            )
            first = told_time()
            assert first
            wait_for(lambda: (now := told_time()) and float(now[1]) > float(first[1]) + 1)


DRIVE = """
proxy(i.DIFFERENTIALROBOT, "robot").setSpeedBase(800.0, 0.0)
middleware.close()
"""


def test_the_only_simulation_is_found_and_one_that_is_not_there_is_told(simulator: Path) -> None:
    domain = f"alone-{os.getpid()}"
    picture = simulator.parent / "live.png"
    ask = [*VIEW, "--domain", domain, "--screenshot", str(picture), "--size", "320x240"]
    none = subprocess.run([*ask, "nobody"], capture_output=True, text=True, check=False)
    assert none.returncode == 1
    assert "nobody" in none.stderr
    assert domain in none.stderr
    assert "Traceback" not in none.stderr
    main = [sys.executable, "main.py", "--domain", domain, "--name"]
    with command(*main, "one", cwd=simulator):
        done = asked(ask, 0)
        assert done.returncode == 0, done.stderr
        assert picture.stat().st_size > 1000
        with command(*main, "other", cwd=simulator):
            done = asked(ask, 1)
            assert "one and other are running: select one, for example `--live one`" in done.stderr
            assert asked([*ask, "other"], 0).returncode == 0


def asked(ask: list[str], code: int) -> subprocess.CompletedProcess[str]:
    """The command, again until it ends so, as simulators need a while to start."""
    deadline = time.monotonic() + PATIENCE
    while True:
        done = subprocess.run(ask, capture_output=True, text=True, check=False)
        if done.returncode == code or time.monotonic() > deadline:
            return done

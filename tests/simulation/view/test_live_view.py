"""The page of `rcgen view --live`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

from robocomp_dsl.simulation.view.live import LivePage
from robocomp_dsl.simulation.view.live_state import UnsupportedSimulation, fetch_live_state
from robocomp_dsl.simulation.view.nodes import quaternion
from robocomp_dsl.simulation.world import visual_state
from tests.simulation.served_worlds import Served, served
from tests.simulation.view.live_world import WORLD, SimulationPort
from tests.support.waiting import wait_until


@pytest.fixture
def live(tmp_path: Path) -> Iterator[LivePage]:
    """A live page of a world in this process; its port is the attribute `hand`."""
    hand: Any = SimulationPort(served(tmp_path, WORLD))
    nodes: Any = SimulationPort(hand.world, "InnerModelManager")
    page = LivePage("sim", hand, nodes=nodes)
    page.hand = hand  # type: ignore[attr-defined]
    yield page
    page.close()


def world_of(live: LivePage) -> Served:
    found: Served = live.hand.world  # type: ignore[attr-defined]
    return found


def text(live: LivePage) -> str:
    message: str = live.page.controls._status.content
    return message


def test_live_view_shows_poses_of_world(live: LivePage) -> None:
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


def test_live_view_switches_pause_time(live: LivePage) -> None:
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


def test_live_view_steps_and_changes_speed(live: LivePage) -> None:
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


def test_live_view_slider_moves_joint_of_world(live: LivePage) -> None:
    world, controls = world_of(live), live.page.controls
    slider, address = next(pair for pair in controls._sliders if pair[0].label == "neck [rad]")
    slider.value = 0.8  # as in the browser
    world.simulation.advance(0.02)
    live.refresh()
    assert slider.value == 0.8, "it stays under the hand"
    world.advance_until(
        lambda: abs(world.ports["Simulation"].getJoints(0, ["neck"])[0] - 0.8) < 0.01
    )
    slider.value = 0.2
    world.advance_until(lambda: world.ports["Simulation"].getJoints(0, ["neck"])[0] < 0.21)
    controls._touched.clear()  # its second is over
    live.refresh()
    assert slider.value == pytest.approx(0.2, abs=0.02)
    assert live.page.data.qpos[address] == pytest.approx(0.2, abs=0.02)


def test_live_view_moves_node_of_world(live: LivePage) -> None:
    world, page = world_of(live), live.page
    live.refresh()
    quat = quaternion((0.0, 0.0, 0.5))
    page.controls.place(page.model.body("robot").id, np.array([0.25, -0.5, 0.125]), quat)
    pose = world.ports["Simulation"].getPoses(0, ["robot"])[0]
    assert (pose.x, pose.y, pose.z) == pytest.approx((250, 125, -500))
    live.refresh()
    assert page.stage.relative[page.model.body("robot").id, 3:] == pytest.approx(quat, abs=1e-6)


def test_live_view_moves_falling_body_in_the_root(live: LivePage) -> None:
    """It starts in a frame of InnerModel, but MuJoCo has it in the world."""
    world, page = world_of(live), live.page
    nodes, pose = world.ports["InnerModelManager"], world.types.Pose3D(1000, 0, 0, 0, 1.0, 0)
    nodes.addTransform("shelf", "static", "floor", pose)
    pose = world.types.Pose3D(0, 3000, 0, 0, 0, 0)
    nodes.addTransform("ball", "bullet", "shelf", pose)

    def is_shown() -> bool:
        live.refresh()
        return "ball" in page.stage.names

    wait_until(is_shown)
    page.controls.place(
        page.model.body("ball").id, np.array([0.25, -0.5, 2.0]), quaternion((0.0, 0.0, 0.5))
    )
    found = world.ports["Simulation"].getPoses(0, ["ball"])[0]
    assert (found.x, found.y, found.z) == pytest.approx((250, 2000, -500))
    world.simulation.advance(0.02)  # it can fall on
    assert world.ports["Simulation"].getPoses(0, ["ball"])[0].y < 2000


def test_live_view_reports_impossible_requests(live: LivePage) -> None:
    far = live.page.controls._remote
    assert far
    far.move("nobody", 1.0, turns=True)
    live.refresh()
    assert text(live).endswith("the command failed: there is no joint `nobody`")
    far.place("nobody", "", np.zeros(3), np.array([1.0, 0, 0, 0]))
    live.refresh()
    assert "the command failed" in text(live)
    assert "`nobody`" in text(live)
    far.reset()
    live.refresh()
    assert "work out" not in text(live)


def test_live_view_shows_added_node(live: LivePage) -> None:
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


def test_live_view_reports_end_of_simulation_and_reconnects(live: LivePage, tmp_path: Path) -> None:
    hand: Any = live.hand  # type: ignore[attr-defined]
    hand.gone = True
    live.refresh()
    assert text(live) == "**sim does not answer**"
    hand.gone, hand.world = False, served(tmp_path, WORLD.replace("neck", "head"))
    live.refresh()
    assert "simulated time 0.00 s" in text(live)
    assert "/world/robot/head" in live.page.stage.paths


def test_live_view_reports_different_mujoco_version(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    world = served(tmp_path, WORLD)
    monkeypatch.setattr(visual_state, "VERSION", "1.2.3")
    hand: Any = SimulationPort(world)
    with pytest.raises(UnsupportedSimulation, match=r"1\.2\.3"):
        fetch_live_state(hand)


def test_live_view_points_move_with_their_body(live: LivePage) -> None:
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

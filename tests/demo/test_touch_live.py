"""The live page of the touch demo: its taxels have the colours of what they feel."""

from contextlib import closing
from types import SimpleNamespace
from urllib.parse import urlsplit

import numpy as np
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.runtime import ServedPort
from robocomp_dsl.simulation.simulation_interface import SIMULATION
from robocomp_dsl.simulation.world.simulation import Simulation, read_data
from tests.demo.component_modules import COMPONENTS
from tests.demo.touch_demo_samples import ARM, demo, part, recording
from tests.support.chromium_tab import needs_chromium, opened_tab
from tests.support.waiting import wait_until


class SimulationPort:
    """The port of the shipped simulator, in this process; its world stands still."""

    def __init__(self) -> None:
        data = COMPONENTS / "nao_simulator" / "nao_simulator_generated" / "scene.json"
        scene = Scene.of_data(read_data(data)["scene"], data.parent)
        simulation = Simulation(scene)
        port = ServedPort("Simulation", SIMULATION)
        self._port = simulation.serve([port], {"Simulation": [""]})["Simulation"]

    def set_timeout(self, _: float) -> None:
        pass

    def __getattr__(self, operation: str) -> object:
        return getattr(self._port, operation)


def buffer_of(it: object) -> object:
    buffer = demo().topic_buffer.TopicBuffer(it.skin, ARM)
    buffer.arm_state(SimpleNamespace(time=0.0, position=part().start, moving=False))
    return buffer


def frame(time: float, force: np.ndarray) -> SimpleNamespace:
    return SimpleNamespace(time=time, force=force)


def test_live_page_sends_only_limbs_with_changed_forces(monkeypatch) -> None:
    it = recording()
    buffer = buffer_of(it)
    buffer.frame(frame(0.0, it.force[0]))
    sent = []
    with closing(demo().live.Live("NAO", SimulationPort(), it.skin, buffer, 0)) as live:
        live.close()  # no more pictures of its own
        monkeypatch.setattr(
            live._page.page, "show_points", lambda name, *rest: sent.append((name, rest))
        )
        live.show()
        assert not sent
        pressed = it.force[np.argmax(it.force.any(axis=1))]
        buffer.frame(frame(0.02, pressed))
        live.show()
    ((name, (body, points, colours, _)),) = sent
    assert name == f"skin of {ARM}/lower_arm"
    assert body == "LForeArm"
    mine = it.skin.of(f"{ARM}/lower_arm")
    assert points.shape == (len(mine), 3)
    felt = pressed[mine] > 0
    bare = (255 * np.array(demo().colours.BARE[:3])).astype(np.uint8)
    assert (colours[~felt] == bare).all()
    assert (colours[felt, 0] > colours[felt, 2] + 60).all()


def test_live_page_reports_occupied_port() -> None:
    it = recording()
    buffer = buffer_of(it)
    buffer.frame(frame(0.0, it.force[0]))
    with closing(demo().live.Live("NAO", SimulationPort(), it.skin, buffer, 0)) as live:
        port = urlsplit(live.url).port or 0
        with pytest.raises(demo().failure.DemoFailed, match=f"no page at port {port}"):
            demo().live.Live("NAO", SimulationPort(), it.skin, buffer, port)


def warm(picture: np.ndarray) -> int:
    """How many points of its middle are yellow to red; beside the robot a finger may wait."""
    width = picture.shape[1]
    red, _, blue = (picture[:, int(0.35 * width) : int(0.55 * width), i] for i in range(3))
    return int(((red > 0.6) & (red - blue > 0.35)).sum())


@needs_chromium
def test_live_page_shows_touch_in_browser() -> None:
    it = recording()
    buffer = buffer_of(it)
    buffer.frame(frame(0.0, it.force[0]))
    with (
        closing(demo().live.Live("NAO", SimulationPort(), it.skin, buffer, 0)) as live,
        opened_tab() as tab,
    ):
        tab("Page.enable")
        tab("Page.navigate", url=live.url)
        wait_until(lambda: tab.shows("Frames"))
        before = warm(tab.picture())
        buffer.frame(frame(0.02, it.force[np.argmax(it.force.any(axis=1))]))
        wait_until(lambda: warm(tab.picture()) > before + 10)
        buffer.frame(frame(1.0, it.force[0]))
        wait_until(lambda: warm(tab.picture()) <= before + 2)

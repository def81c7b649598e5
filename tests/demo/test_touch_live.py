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
from tests.demo.parts import COMPONENTS
from tests.demo.touched import ARM, demo, part, recording
from tests.support.chromium_tab import needs_chromium, opened_tab, wait_for


class Hand:
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


def heard_of(it: object) -> object:
    heard = demo().topic_buffer.TopicBuffer(it.skin, ARM)
    heard.arm_state(SimpleNamespace(time=0.0, position=part().start, moving=False))
    return heard


def frame(time: float, force: np.ndarray) -> SimpleNamespace:
    return SimpleNamespace(time=time, force=force)


def test_only_limbs_that_feel_something_else_are_sent_again(monkeypatch) -> None:
    it = recording()
    heard = heard_of(it)
    heard.frame(frame(0.0, it.force[0]))
    sent = []
    with closing(demo().live.Live("NAO", Hand(), it.skin, heard, 0)) as live:
        live.close()  # no more pictures of its own
        monkeypatch.setattr(
            live._page.page, "show_points", lambda name, *rest: sent.append((name, rest))
        )
        live.show()
        assert not sent
        pressed = it.force[np.argmax(it.force.any(axis=1))]
        heard.frame(frame(0.02, pressed))
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


def test_a_port_that_is_taken_is_told() -> None:
    it = recording()
    heard = heard_of(it)
    heard.frame(frame(0.0, it.force[0]))
    with closing(demo().live.Live("NAO", Hand(), it.skin, heard, 0)) as live:
        port = urlsplit(live.url).port or 0
        with pytest.raises(demo().failure.DemoFailed, match=f"no page at port {port}"):
            demo().live.Live("NAO", Hand(), it.skin, heard, port)


def warm(picture: np.ndarray) -> int:
    """How many points of its middle are yellow to red; beside the robot a finger may wait."""
    width = picture.shape[1]
    red, _, blue = (picture[:, int(0.35 * width) : int(0.55 * width), i] for i in range(3))
    return int(((red > 0.6) & (red - blue > 0.35)).sum())


@needs_chromium
def test_a_real_browser_shows_the_touch() -> None:
    it = recording()
    heard = heard_of(it)
    heard.frame(frame(0.0, it.force[0]))
    with (
        closing(demo().live.Live("NAO", Hand(), it.skin, heard, 0)) as live,
        opened_tab() as tab,
    ):
        tab("Page.enable")
        tab("Page.navigate", url=live.url)
        wait_for(lambda: tab.shows("Frames"))
        before = warm(tab.picture())
        heard.frame(frame(0.02, it.force[np.argmax(it.force.any(axis=1))]))
        wait_for(lambda: warm(tab.picture()) > before + 10)
        heard.frame(frame(1.0, it.force[0]))
        wait_for(lambda: warm(tab.picture()) <= before + 2)

"""A program that looks into a deployment: it asks and hears as a component does, and is none."""

from __future__ import annotations

import time
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces
from robocomp_dsl.runtime.component.component_interface import COMPONENT
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_interface import CLOCK, ClockProxy, Tick

COMPONENTS = Path(__file__).parents[2] / "components"
DEADLINE = 60.0


class Teller(Component):
    """Tells the time, whether anybody lives by it or not."""

    SPEC = ComponentSpec(
        name="teller",
        period=5,
        middleware="inproc",
        publishes=(CalledPort("Clock", ClockProxy, "clock_proxy"),),
    )
    clock_proxy: ClockProxy

    def compute(self) -> None:
        self.clock_proxy.tick(Tick(7))


@pytest.fixture
def onlooker() -> Iterator[DomainClient]:
    domain = uuid.uuid4().hex
    runner = Runner(Teller, Parameters(), RunSettings(domain=domain))
    runner.start()
    client = DomainClient(domain, "inproc")
    yield client
    client.close()
    runner.stop()
    assert runner.wait()


def test_it_asks_components_about_themselves_and_calls_their_ports(onlooker: DomainClient) -> None:
    proxy = onlooker.component("teller")
    assert proxy.wait_for_server(DEADLINE)
    assert proxy.getInfo().name == "teller"
    assert onlooker.operations(COMPONENT, "teller", "Component").getInfo().name == "teller"


def test_it_hears_what_is_published(onlooker: DomainClient) -> None:
    heard: list[Tick] = []
    onlooker.subscribe(CLOCK, "teller", "Clock", {"tick": heard.append})
    end = time.monotonic() + DEADLINE
    while not heard:
        assert time.monotonic() < end, "nothing was heard"
        time.sleep(0.002)
    assert heard[0].time == 7


def test_interfaces_of_components_are_modules_of_their_own() -> None:
    reflex, arm = (
        load_generated_interfaces(COMPONENTS / name) for name in ("reflex", "generic_arm")
    )
    assert reflex is load_generated_interfaces(COMPONENTS / "reflex")
    assert reflex.GENERICARM.name == arm.GENERICARM.name
    assert reflex is not arm
    with pytest.raises(FileNotFoundError):
        load_generated_interfaces(COMPONENTS / "nowhere")

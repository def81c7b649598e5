"""A client of a domain: calls components and subscribes to their publications."""

from __future__ import annotations

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
from tests.support.waiting import wait_until

COMPONENTS = Path(__file__).parents[2] / "components"
DEADLINE = 60.0


class TickPublisher(Component):
    """Publishes the same tick in every cycle."""

    SPEC = ComponentSpec(
        name="publisher",
        period=5,
        middleware="inproc",
        publishes=(CalledPort("Clock", ClockProxy, "clock_proxy"),),
    )
    clock_proxy: ClockProxy

    def compute(self) -> None:
        self.clock_proxy.tick(Tick(7))


@pytest.fixture
def client() -> Iterator[DomainClient]:
    domain = uuid.uuid4().hex
    runner = Runner(TickPublisher, Parameters(), RunSettings(domain=domain))
    runner.start()
    client = DomainClient(domain, "inproc")
    yield client
    client.close()
    runner.stop()
    assert runner.wait()


def test_domain_client_calls_component_operations(client: DomainClient) -> None:
    proxy = client.component("publisher")
    assert proxy.wait_for_server(DEADLINE)
    assert proxy.getInfo().name == "publisher"
    assert client.operations(COMPONENT, "publisher", "Component").getInfo().name == "publisher"


def test_domain_client_receives_published_messages(client: DomainClient) -> None:
    ticks: list[Tick] = []
    client.subscribe(CLOCK, "publisher", "Clock", {"tick": ticks.append})
    wait_until(lambda: ticks, "a tick")
    assert ticks[0].time == 7


def test_load_generated_interfaces_gives_each_component_own_module() -> None:
    reflex, arm = (
        load_generated_interfaces(COMPONENTS / name) for name in ("reflex", "generic_arm")
    )
    assert reflex is load_generated_interfaces(COMPONENTS / "reflex")
    assert reflex.GENERICARM.name == arm.GENERICARM.name
    assert reflex is not arm
    with pytest.raises(FileNotFoundError):
        load_generated_interfaces(COMPONENTS / "nowhere")

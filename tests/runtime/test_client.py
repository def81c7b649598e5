"""A client of a domain: calls components and subscribes to their publications."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.client import (
    DomainClient,
    SchemaError,
    load_generated_interfaces,
    struct_to_plain,
)
from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentInfo
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_interface import CLOCK, ClockProxy, Tick
from tests.support.waiting import wait_until

COMPONENTS = Path(__file__).parents[2] / "components"
DEADLINE = 60.0
COMPONENT_HASH = "b63640e12e0223ad"
"""Components of all versions can be asked only while this does not change."""


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


def test_domain_client_describes_component_with_units_and_docs(client: DomainClient) -> None:
    description = client.describe("publisher", DEADLINE)
    port = description.port("Clock", "publishes")
    assert port.interface.hash == CLOCK.hash
    assert [port.name for port in description.ports] == ["Clock", "Component"]
    assert description.type_infos["RoboCompClock::Tick"].fields[0].unit == "ns"
    field = description.field_info("RoboCompClock::Tick", "time")
    assert field is not None
    assert "0 at the start" in field.doc


def test_domain_client_uses_built_types(client: DomainClient) -> None:
    description = client.describe("publisher", DEADLINE)
    port = description.port("Clock")
    ticks: list[Struct] = []
    client.subscribe(port.interface, "publisher", "Clock", {"tick": ticks.append})
    wait_until(lambda: ticks, "a tick was received")
    component = description.port("Component")
    operations = client.operations(component.interface, "publisher", "Component")
    info = struct_to_plain(operations.getInfo())
    assert (info["name"], info["state"]) == ("publisher", "Compute")
    rejected = description.types["RoboCompComponent::Refusal"]
    with pytest.raises(rejected, match="out of range"):
        operations.setPeriod(-1)


def test_domain_client_finds_components(client: DomainClient) -> None:
    assert client.components(DEADLINE) == ["publisher"]


def test_domain_client_reports_absent_component(client: DomainClient) -> None:
    with pytest.raises(NoServer, match="no component `nobody`"):
        client.describe("nobody", 0.01)


def test_component_of_older_version_answers_as_before(
    client: DomainClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It serves `Component` with a hash that does not cover units, no shapes, and no schema."""
    monkeypatch.setattr("robocomp_dsl.runtime.client._SCHEMA_TIMEOUT_S", 0.01)
    assert COMPONENT.hash_without_units.hex() == COMPONENT_HASH
    older = Interface(COMPONENT.name, *COMPONENT.operations)
    older.__dict__["hash"] = bytes.fromhex(COMPONENT_HASH)
    monkeypatch.setattr(client._middleware.presence, "offer_shapes", lambda _: None)
    handlers = {operation.name: ComponentInfo for operation in COMPONENT.operations}
    at = Endpoint(older, "older", "Component")
    client._middleware.serve(at, handlers, CallbackGroup())
    assert client.component("older").getInfo() == ComponentInfo()
    with pytest.raises(SchemaError, match="older version of robocomp_dsl; update it"):
        client.describe("older", DEADLINE)

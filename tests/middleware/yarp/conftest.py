"""Components whose ports are on YARP, and a name server of their own."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from robocomp_dsl.runtime.presence.port_record import PortRecord

LOOPBACK = "127.0.0.1"


class Pose(rt.Struct):
    x: rt.Double = 0.0
    y: rt.Double = 0.0
    frame: rt.String = ""


class NoPath(rt.DeclaredError):
    reason: rt.String = ""


ROBOT = rt.Interface(
    "Test::Robot",
    rt.Operation("add", inputs={"a": rt.Int, "b": rt.Int}, returns=rt.Int),
    rt.Operation("plan", inputs={"goal": Pose}, returns=rt.Float64Array, throws=(NoPath,)),
    rt.Operation("isReady", returns=rt.Bool),
    rt.Operation("say", rt.Pattern.COMMAND, inputs={"text": rt.String}),
)
SCAN = rt.Interface(
    "Test::Scan", rt.Operation("ranges", rt.Pattern.PUBLISH, {"meters": rt.Float64Array})
)
POSE = rt.Interface("Test::PosePub", rt.Operation("at", rt.Pattern.PUBLISH, {"pose": Pose}))
EVENTS = rt.Interface(
    "Test::Events",
    rt.Operation("event", rt.Pattern.PUBLISH, {"name": rt.String, "level": rt.Int}),
)


class YarpComponent:
    """One component whose ports are on YARP."""

    def __init__(self, name: str, domain: str, names: tuple[str, int], **options: Any) -> None:
        self.name = name
        self.statistics = Statistics()
        self.group = CallbackGroup()
        settings = {("yarp", "name_server"): f"{names[0]}:{names[1]}"}
        settings |= options.pop("transport_settings", {})
        self.context = ComponentContext(
            name, domain, self.group, self.statistics, transport_settings=settings, **options
        )
        self.ports: ComponentPorts = open_ports("yarp", self.context)

    def endpoint(self, interface: Interface, *external: str, qos: Qos | None = None) -> Endpoint:
        """The port of an interface; `external` are addresses of programs of YARP."""
        port = interface.name.rpartition("::")[2]
        records = tuple(
            PortRecord("server", interface.name, "plain", port, "", "yarp", address)
            for address in external
        )
        return Endpoint(interface, self.name, port, (), qos or Qos(), ("yarp",), records)

    def serve(self, interface: Interface, handlers: dict[str, Callable[..., Any]]) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(self.endpoint(interface), every, self.group)

    def subscribe(self, interface: Interface, handler: Callable[..., Any], *external: str) -> None:
        handlers = {operation.name: handler for operation in interface.operations}
        self.ports.subscribe(self.endpoint(interface, *external), handlers, self.group)

    def caller(self, interface: Interface, operation: str, *external: str) -> Callable[..., Any]:
        """A function that calls an operation of another port."""
        channel = self.ports.proxy(self.endpoint(interface, *external))
        return channel.bind(interface.operation(operation))

    def outputs(self, port: str) -> Callable[[], list[str]]:
        """A function that lists the readers of a published port."""
        transport: Any = self.ports.transport("yarp")
        links = transport.outputs[port]
        return lambda: list(links.carriers())

    def inputs(self, port: str) -> Callable[[], list[str]]:
        """A function that lists the programs that write to a subscribed port."""
        transport: Any = self.ports.transport("yarp")
        opened = transport.received[port]
        return lambda: list(opened.inputs())

    def publisher(self, interface: Interface, *external: str) -> Callable[..., None]:
        """A function that publishes the only operation of a topic."""
        channel = self.ports.advertise(self.endpoint(interface, *external))
        return channel.bind(interface.operations[0])


@pytest.fixture
def domain() -> str:
    return f"test-{uuid.uuid4().hex[:12]}"


@pytest.fixture
def name_server() -> Iterator[NameServer]:
    server = NameServer((LOOPBACK, 0))
    yield server
    server.close()


@pytest.fixture
def names(name_server: NameServer) -> NameClient:
    """The name server as a client sees it."""
    return NameClient((LOOPBACK, name_server.number))


@pytest.fixture
def component(domain: str, name_server: NameServer) -> Iterator[Callable[..., YarpComponent]]:
    """Opens components; they end with the test."""
    opened: list[YarpComponent] = []

    def open_component(name: str = "own", **options: Any) -> YarpComponent:
        at = (LOOPBACK, name_server.number)
        opened.append(YarpComponent(name, domain, at, **options))
        return opened[-1]

    yield open_component
    for each in opened:
        each.ports.close()

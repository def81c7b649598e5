"""A real YARP 3.5 and components: tools, Python bindings, and both name servers."""

from __future__ import annotations

import pathlib
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime import MessageStamp, message_stamp, publishing_stamp
from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.errors import NoServer, RemoteError
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from robocomp_dsl.runtime.middleware.yarp.outgoing import ask_admin
from robocomp_dsl.runtime.middleware.yarp.registration import ASK_S
from tests.middleware.yarp.conftest import EVENTS, LOOPBACK, POSE, ROBOT, SCAN, Pose, YarpComponent
from tests.middleware.yarp.sensor_messages import CAMERA, LEVELS, Image, image_of, pixels_of
from tests.middleware.yarp.test_yarp_robustness import GRIPPER, Grip
from tests.middleware.yarp.test_yarp_thrift import PATH, PATH_TEXT, check_calls
from tests.middleware.yarp.test_yarp_transport import HANDLERS
from tests.middleware.yarp.thrift_types import DEMO, PATHS, DemoHandlers, Path
from tests.middleware.yarp.yarp_tools import (
    Tools,
    free_port,
    needs_thrift_peer,
    needs_yarp,
)
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_yarp]
Components = Callable[..., YarpComponent]


@pytest.fixture(params=["yarpserver", "own"])
def tools(request: pytest.FixtureRequest, tmp_path: pathlib.Path) -> Iterator[Tools]:
    """YARP's programs, with YARP's name server or ours."""
    number = free_port()
    opened = Tools(tmp_path, number)
    own = NameServer((LOOPBACK, number)) if request.param == "own" else None
    if own is None:
        opened.start_name_server()
    yield opened
    opened.close()
    if own:
        own.close()


@pytest.fixture
def names(tools: Tools) -> NameClient:
    client = NameClient((LOOPBACK, tools.number))
    wait_until(lambda: client.query("/root"), ignoring=NameServerLost)
    return client


@pytest.fixture
def component(names: NameClient, domain: str) -> Iterator[Components]:
    opened: list[YarpComponent] = []

    def open_component(name: str = "own", **options: Any) -> YarpComponent:
        opened.append(YarpComponent(name, domain, names.at, **options))
        return opened[-1]

    yield open_component
    for each in opened:
        each.ports.close()


def test_yarp_tools_find_ports(component: Components, names: NameClient, tools: Tools) -> None:
    component("server").serve(ROBOT, HANDLERS)
    port = "/server/Robot/rpc:i"
    wait_until(lambda: names.query(port))
    assert port in tools.run("name", "list").stdout
    assert tools.run("exists", port).returncode == 0
    assert tools.run("exists", "/nobody").returncode != 0
    assert f'This is "{port}" at "tcp://127.0.0.1:' in tools.run("ping", port).stdout


def test_yarp_rpc_calls_operations(component: Components, names: NameClient, tools: Tools) -> None:
    component("server").serve(ROBOT, HANDLERS)
    port = "/server/Robot/rpc:i"
    wait_until(lambda: names.query(port))
    text = "add 1 2\nisReady\nplan (1.0 2.0 moon)\nadd 1 x\nhelp\n"
    output = tools.run("rpc", port, text=text).stdout
    assert "Response: [ok] 3\n" in output
    assert "Response: [ok] true\n" in output
    assert 'declared NoPath ("no way to moon")' in output
    assert "malformed" in output
    assert "*** Available commands:\n  add a b\n" in output  # as those of yarpidl_thrift


def test_yarp_read_connects_to_publisher(
    component: Components, names: NameClient, tools: Tools
) -> None:
    own = component()
    publish = own.publisher(EVENTS)
    wait_until(lambda: names.query("/own/Events:o"))
    reader = tools.start("read", "/reader", "/own/Events:o")
    channel_has_reader = own.outputs("Events")
    wait_until(lambda: "/reader" in channel_has_reader())
    publish("bump", 3)
    assert tools.line_of(reader) == "event bump 3\n"


@pytest.mark.parametrize("carrier", ["tcp", "fast_tcp", "text", "text_ack"])
def test_yarp_connect_and_disconnect(
    component: Components, names: NameClient, tools: Tools, carrier: str
) -> None:
    own = component()
    publish = own.publisher(SCAN)
    reader = tools.start("read", "/reader")
    for port in ("/own/Scan:o", "/reader"):
        wait_until(lambda port=port: names.query(port))
    # A program of YARP registers its port before it listens.
    wait_until(lambda: tools.run("connect", "/own/Scan:o", "/reader", carrier).returncode == 0)
    publish(np.array([1.5, 2.5]))
    assert tools.line_of(reader) == "1.5 2.5\n"
    if carrier == "tcp":  # the tool asks for no other
        assert tools.run("exists", "/own/Scan:o", "/reader").returncode == 0
    assert own.outputs("Scan")() == ["/reader"]
    assert tools.run("disconnect", "/own/Scan:o", "/reader").returncode == 0
    assert own.outputs("Scan")() == []
    assert tools.run("exists", "/own/Scan:o", "/reader").returncode != 0


@pytest.mark.parametrize("prefix", ["", "text://", "fast_tcp://"])
def test_yarp_write_sends_to_subscriber(
    component: Components, names: NameClient, tools: Tools, prefix: str
) -> None:
    received: list[Any] = []
    own = component()
    own.subscribe(POSE, received.append)
    wait_until(lambda: names.query("/own/PosePub:i"))
    target = f"{prefix}/own/PosePub:i".replace(":///", "://") if prefix else "/own/PosePub:i"

    def written() -> bool:
        """Over text, a writer that ends at once may reset its connection before it is read."""
        tools.run("write", "/writer", target, text="1.5 2 map\n")
        return bool(received)

    wait_until(written)
    assert received[0] == Pose(1.5, 2.0, "map")


def test_component_reads_and_calls_yarp_ports(
    component: Components, names: NameClient, tools: Tools
) -> None:
    """A program with YARP's own Python bindings writes a Vector, and replies to requests."""
    received: list[list[float]] = []
    own = component()
    own.subscribe(SCAN, lambda meters: received.append(meters.tolist()), "/plain:o")
    add, missing = own.caller(ROBOT, "add", "/plain/rpc"), own.caller(ROBOT, "add", "/nobody")
    with pytest.raises(NoServer):
        missing(1, 2)
    tools.python(PLAIN)
    wait_until(lambda: [1.5, 2.5] in received)
    assert wait_until(lambda: add(20, 22), ignoring=NoServer) == 42


PLAIN = """
import time
import yarp
yarp.Network.init()
writer, server = yarp.Port(), yarp.RpcServer()
writer.open("/plain:o")
server.open("/plain/rpc")
vector = yarp.Vector(2)
vector.set(0, 1.5)
vector.set(1, 2.5)
request, reply = yarp.Bottle(), yarp.Bottle()
while True:
    writer.write(vector)
    if server.getInputCount() and server.read(request, True):
        reply.clear()
        reply.addInt32(request.get(1).asInt32() + request.get(2).asInt32())
        server.reply(reply)
    time.sleep(0.01)
"""


def test_restarted_yarpserver_learns_the_ports_again(
    component: Components, names: NameClient, tools: Tools, request: pytest.FixtureRequest
) -> None:
    if "own" in request.node.name:
        pytest.skip("test_yarp_transport restarts our name server")
    component("server").serve(ROBOT, HANDLERS)
    wait_until(lambda: names.query("/server/Robot/rpc:i"))
    tools.restart_name_server()
    wait_until(lambda: names.query("/server/Robot/rpc:i"), ignoring=NameServerLost)
    output = tools.run("rpc", "/server/Robot/rpc:i", text="add 1 2\n").stdout
    assert "Response: [ok] 3\n" in output


@needs_thrift_peer
def test_component_calls_a_server_of_yarpidl_thrift(component: Components, tools: Tools) -> None:
    tools.start("serve", "/demo", program="demo_peer")
    client = component()
    place = client.caller(DEMO, "place", "/demo")
    wait_until(lambda: place() == 0, ignoring=NoServer)
    check_calls(client, None, "/demo")
    with pytest.raises(RemoteError):
        client.caller(DEMO, "measure_path", "/demo")(Path())


@needs_thrift_peer
def test_client_of_yarpidl_thrift_calls_a_component(
    component: Components, names: NameClient, tools: Tools
) -> None:
    served = DemoHandlers()
    component("server").serve(DEMO, served.handlers())  # type: ignore[arg-type]
    wait_until(lambda: names.query("/server/Demo/rpc:i"))
    client = tools.start("call", "/server/Demo/rpc:i", program="demo_peer")
    line = tools.line_of(client)
    assert line == f"3 10 hey! {(1 << 40) + 1} 0.5 3 -150 zyx b z 5 6 2126\n"
    assert tools.line_of(client) == f"{PATH_TEXT}\n"
    wait_until(lambda: served.place == 7)


@needs_thrift_peer
def test_component_reads_a_struct_of_yarpidl_thrift(
    component: Components, names: NameClient, tools: Tools
) -> None:
    received: list[Path] = []
    component().subscribe(PATHS, received.append)
    wait_until(lambda: names.query("/own/Paths:i"))
    tools.start("publish", "/path:o", "/own/Paths:i", program="demo_peer")
    wait_until(lambda: received == [PATH])


def test_published_struct_is_a_request_to_an_rpc_port(
    component: Components, names: NameClient, tools: Tools
) -> None:
    server = tools.python(GRIPPER_SERVER)
    wait_until(lambda: names.query("/gripper/rpc:i"))
    component().publisher(GRIPPER, "/gripper/rpc:i")(Grip("set", "opening", 1, 12.5))
    assert tools.line_of(server) == "set opening 1 12.5\n"


GRIPPER_SERVER = """
import yarp
yarp.Network.init()
port, request = yarp.RpcServer(), yarp.Bottle()
port.open("/gripper/rpc:i")
while True:
    if port.read(request, True):
        print(request.toString())
        port.reply(request)
"""


def test_stamps_and_data_of_yarp(component: Components, names: NameClient, tools: Tools) -> None:
    """A program of YARP writes what it reads: images, a Property, and envelopes."""
    images: list[tuple[Image, MessageStamp]] = []
    maps: list[tuple[dict[str, float], MessageStamp]] = []
    own = component()
    own.subscribe(CAMERA, lambda image: images.append((image, message_stamp())), "/mirror/Camera:o")
    own.subscribe(LEVELS, lambda each: maps.append((each, message_stamp())), "/mirror/Levels:o")
    push = own.publisher(CAMERA, "fast_tcp:/mirror/Camera:i")
    levels = own.publisher(LEVELS, "/mirror/Levels:i")
    mirror = tools.python(MIRROR)
    readers = read_text("[list] [out]")
    for port in ("Camera", "Levels"):
        writer = wait_until(lambda port=port: names.query(f"/mirror/{port}:o"))
        wait_until(
            lambda writer=writer: len(ask_admin(writer, "admin", readers, ASK_S)),
            ignoring=ConnectionLost,
        )
    for number, image in enumerate(PROBES):
        with publishing_stamp(1_500_000_000 * (number + 1), number):
            push(image)
        wait_until(lambda number=number: _stamped(images, number))
        returned, stamp = _stamped(images, number)[0]
        assert stamp == (1_500_000_000 * (number + 1), "envelope", number)
        assert returned.header.stamp.sec == 3 * (number + 1) // 2
        assert pixels_of(returned) == pixels_of(image)
    with publishing_stamp(2_250_000_000, 9):
        levels({"left arm": 1.5, "torso": 2.0})
    wait_until(lambda: maps)
    assert maps[-1] == (
        {"left arm": 1.5, "torso": 2.0},
        MessageStamp(2_250_000_000, "envelope", 9),
    )
    assert mirror.poll() is None


def _stamped(
    images: list[tuple[Image, MessageStamp]], number: int
) -> list[tuple[Image, MessageStamp]]:
    return [each for each in images if each[1].sequence == number]


PROBES = [
    image_of("rgb8", 4, 2, step=12),
    image_of("rgb8", 5, 3, step=15),
    image_of("rgb8", 5, 2, step=16),
    image_of("mono8", 5, 2, step=5),
    image_of("mono16", 3, 2, step=6),
    image_of("bgra8", 3, 2, step=100),
    image_of("32FC1", 3, 2, step=12),
    image_of("bayer_rggb8", 4, 2, step=4),
]

MIRROR = """
import time
import yarp
yarp.Network.init()
kinds = {"Camera": yarp.FlexImage, "Levels": yarp.Property}
ports = {}
for name in kinds:
    ports[name] = (yarp.Port(), yarp.Port())
    ports[name][0].open("/mirror/%s:i" % name)
    ports[name][1].open("/mirror/%s:o" % name)

def run(name):
    reader, writer = ports[name]
    while True:
        data, stamp = kinds[name](), yarp.Stamp()
        if reader.read(data) and reader.getEnvelope(stamp):
            writer.setEnvelope(stamp)
        writer.write(data)

import threading
for name in kinds:
    threading.Thread(target=run, args=(name,), daemon=True).start()
while True:
    time.sleep(1)
"""

"""A real YARP 3.5 and components: tools, Python bindings, and both name servers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from tests.middleware.yarp.conftest import EVENTS, LOOPBACK, POSE, ROBOT, SCAN, Pose, YarpComponent
from tests.middleware.yarp.test_yarp_transport import HANDLERS
from tests.middleware.yarp.yarp_tools import Tools, free_port, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_yarp]
Components = Callable[..., YarpComponent]


@pytest.fixture(params=["yarpserver", "own"])
def tools(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Tools]:
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
    connected = tools.run("connect", "/own/Scan:o", "/reader", carrier)
    assert connected.returncode == 0, connected
    publish(np.array([1.5, 2.5]))
    assert tools.line_of(reader) == "1.5 2.5\n"
    assert tools.run("exists", "/own/Scan:o", "/reader", carrier).returncode == 0
    assert tools.run("disconnect", "/own/Scan:o", "/reader").returncode == 0
    assert tools.run("exists", "/own/Scan:o", "/reader", carrier).returncode != 0


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

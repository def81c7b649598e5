"""Components on YARP, as programs of YARP see them, and external peers."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest

from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import (
    MalformedMessage,
    MiddlewareError,
    NoServer,
    RemoteError,
    Timeout,
)
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from robocomp_dsl.runtime.middleware.yarp.outgoing import ask_admin, open_connection
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from tests.middleware.yarp.conftest import (
    EVENTS,
    LOOPBACK,
    POSE,
    ROBOT,
    SCAN,
    NoPath,
    Pose,
    YarpComponent,
)
from tests.middleware.yarp.test_yarp_wire import Recorder
from tests.support.waiting import wait_until

LIMIT_S = 60.0
Components = Callable[..., YarpComponent]


def refuse(goal: Pose) -> None:
    raise NoPath(f"no way to {goal.frame}")


HANDLERS = {"add": lambda a, b: a + b, "plan": refuse, "isReady": lambda: True}


def rpc(names: NameClient, name: str, request: str) -> str:
    """The reply to a request in text, as `yarp rpc` shows it."""
    at = wait_until(lambda: names.query(name, "text_ack"))
    stream = open_connection(at, "/rpc", LIMIT_S)
    try:
        stream.send(f"d\r\n{request}\r\n".encode())
        reply = stream.line()
        assert stream.line() == "<ACK>"
        return reply
    finally:
        stream.close()


@pytest.mark.parametrize(
    ("request_", "reply"),
    [
        ("add 1 2", "[ok] 3"),
        ("[add] 1 2.0", "[ok] 3"),
        ("isReady", "[ok] true"),
        ('plan (1.0 2.0 "the moon")', re.escape("[fail] \"NoPath: NoPath(reason='no way to the")),
        ("add 1", r'\[fail\] ".*has 1 values \(int32\), but should have: a int, b int" malformed'),
        ("add 1 x", r'\[fail\] ".*field b.*`x` is no int" malformed'),
        ("add 1 3000000000", r"\[fail\] .*3000000000 does not fit into an int.* malformed"),
        ("nonsense", r'\[fail\] "server.Robot has no operation `nonsense`; it has add, plan,'),
        ("", r"\[fail\] "),
        ("help", r'\[many\] "\*\*\* Available commands:" "add a b" "plan goal" isReady "say text"'),
    ],
)
def test_requests_in_text(
    component: Components, names: NameClient, request_: str, reply: str
) -> None:
    component("server").serve(ROBOT, HANDLERS)
    found = rpc(names, "/server/Robot/rpc:i", request_)
    assert found == reply or re.match(reply, found)


def test_request_of_a_command_is_replied_to(component: Components, names: NameClient) -> None:
    heard: list[str] = []
    component("server").serve(ROBOT, {**HANDLERS, "say": heard.append})
    assert rpc(names, "/server/Robot/rpc:i", 'say "hello world"') == ""
    wait_until(lambda: heard == ["hello world"])


@pytest.mark.parametrize("carrier", ["tcp", "fast_tcp", "text", "text_ack"])
def test_external_server(
    component: Components, name_server: NameServer, names: NameClient, carrier: str
) -> None:
    server = YarpComponent("server", f"test-{carrier}", (LOOPBACK, name_server.number))
    server.serve(ROBOT, HANDLERS)
    wait_until(lambda: names.query("/server/Robot/rpc:i"))
    address = f"{carrier}:/server/Robot/rpc:i"
    client = component("client")
    assert client.caller(ROBOT, "add", address)(1, 2) == 3
    assert client.caller(ROBOT, "isReady", address)() is True
    with pytest.raises(NoPath, match="no way to here"):
        client.caller(ROBOT, "plan", address)(Pose(1.0, 2.0, "here"))
    server.ports.close()


@pytest.mark.parametrize(
    ("reply", "operation", "result"),
    [
        ("3", "add", 3),
        ("[ok] 3", "add", 3),
        ("[ok]", "isReady", True),
        ("[fail]", "isReady", False),
        ("false", "isReady", False),
        ("[fail] broken", "isReady", RemoteError("plain.Robot.isReady failed: broken")),
        ("[fail]", "add", RemoteError("plain.Robot.add failed: it reported a failure without")),
        ("", "add", MalformedMessage("the reply of plain.Robot.add: has no values")),
        ('"x"', "add", MalformedMessage("the reply of plain.Robot.add: `x` is no int")),
    ],
)
def test_replies_of_plain_programs(
    component: Components, names: NameClient, reply: str, operation: str, result: object
) -> None:
    recorder = Recorder()
    recorder.reply = read_text(reply)
    plain = YarpPort("/plain", (LOOPBACK, 0), recorder)
    names.register("/plain", LOOPBACK, plain.number)
    call = component().caller(ROBOT, operation, "/plain")
    arguments = (1, 2) if operation == "add" else ()
    try:
        if isinstance(result, Exception):
            with pytest.raises(type(result)) as caught:
                call(*arguments)
            text = caught.value.reason if hasattr(caught.value, "reason") else str(caught.value)
            assert text.startswith(str(result.args[0]))
        else:
            assert call(*arguments) == result
    finally:
        plain.close()
    assert recorder.received == ["add 1 2" if arguments else operation]


def test_external_server_is_missing(component: Components, names: NameClient) -> None:
    call = component().caller(ROBOT, "isReady", "/nobody")
    with pytest.raises(NoServer, match="the name server knows no port /nobody; start it, or"):
        call()
    names.register("/nobody", LOOPBACK, 1)
    with pytest.raises(NoServer, match="cannot be reached: Connection refused"):
        call()


def test_external_server_is_found_again_after_restart(
    component: Components, names: NameClient
) -> None:
    recorder = Recorder()
    first = YarpPort("/plain", (LOOPBACK, 0), recorder)
    names.register("/plain", LOOPBACK, first.number)
    call = component().caller(ROBOT, "add", "/plain")
    assert call(1, 2) == 77
    first.close()
    second = YarpPort("/plain", (LOOPBACK, 0), recorder)
    names.register("/plain", LOOPBACK, second.number)
    assert wait_until(lambda: call(1, 2), ignoring=NoServer) == 77
    second.close()


class Silent(Recorder):
    """Never replies while the test runs."""

    def __init__(self) -> None:
        super().__init__()
        import threading  # noqa: PLC0415

        self.free = threading.Event()

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        self.free.wait(LIMIT_S)
        return []


def test_call_of_silent_server_times_out(component: Components) -> None:
    silent = Silent()
    plain = YarpPort("/plain", (LOOPBACK, 0), silent)
    own = component()
    channel = own.ports.proxy(own.endpoint(ROBOT, f"/plain@127.0.0.1:{plain.number}"))
    channel.timeout = 0.05
    with pytest.raises(Timeout, match=r"did not reply within 0.05 s"):
        channel.bind(ROBOT.operation("isReady"))()
    silent.free.set()
    plain.close()


@pytest.mark.parametrize("carrier", ["tcp", "fast_tcp", "text", "text_ack"])
def test_publisher_sends_to_external_reader(
    component: Components, names: NameClient, carrier: str
) -> None:
    recorder = Recorder()
    publish = component().publisher(EVENTS, f"{carrier}:/reader")
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)  # it starts later
    names.register("/reader", LOOPBACK, reader.number)
    wait_until(lambda: publish("bump", 3) or recorder.received)
    assert set(recorder.received) == {"event bump 3"}
    reader.close()
    restarted = Recorder()
    second = YarpPort("/reader", (LOOPBACK, 0), restarted)
    names.register("/reader", LOOPBACK, second.number)
    wait_until(lambda: publish("again", 4) or "event again 4" in restarted.received)
    second.close()


def test_plain_topics_are_values_without_names(component: Components, names: NameClient) -> None:
    recorder = Recorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)
    names.register("/reader", LOOPBACK, reader.number)
    own = component()
    scan, pose = own.publisher(SCAN, "/reader"), own.publisher(POSE, "text:/reader")
    wait_until(lambda: scan(np.array([1.5, 2.5])) or "1.5 2.5" in recorder.received)
    wait_until(lambda: pose(Pose(1.0, 2.0, "map")) or "1.0 2.0 map" in recorder.received)
    reader.close()


def test_connections_of_yarp_connect(component: Components, names: NameClient) -> None:
    """`yarp connect` and `yarp disconnect` send these commands to the publisher."""
    recorder = Recorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)
    names.register("/reader", LOOPBACK, reader.number)
    publish = component().publisher(EVENTS)
    at = wait_until(lambda: names.query("/own/Events:o"))

    def admin(command: str) -> str:
        return write_text(ask_admin(at, "admin", read_text(command), LIMIT_S))

    assert admin('[list] [out] "/reader"') == ""
    assert admin('[add] "tcp://none"') == '-1 "Do not know how to connect to tcp://none\\r\\n"'
    assert admin('[add] "shmoo://reader"') == '-1 "Cannot connect to shmoo://reader\\r\\n"'
    added = admin('[add] "tcp://reader"')
    assert added == '0 "Added connection from /own/Events:o to tcp://reader\\r\\n"'
    assert admin('[list] [out] "/reader"') == (
        '(from "/own/Events:o") (to "/reader") (carrier tcp)'
    )
    publish("bump", 3)
    wait_until(lambda: recorder.received == ["event bump 3"])
    assert admin('[del] "/reader"').startswith('0 "Removed connection')
    wait_until(lambda: reader.inputs() == {})
    assert admin("[list] [out]") == ""
    reader.close()


def test_connection_ends_with_its_reader(component: Components, names: NameClient) -> None:
    reader = YarpPort("/reader", (LOOPBACK, 0), Recorder())
    names.register("/reader", LOOPBACK, reader.number)
    component().publisher(EVENTS)
    at = wait_until(lambda: names.query("/own/Events:o"))
    assert ask_admin(at, "admin", read_text("[add] fast_tcp://reader"), LIMIT_S)[0] == 0
    reader.close()
    command = read_text("[list] [out]")
    wait_until(lambda: len(ask_admin(at, "admin", command, LIMIT_S)) == 0)


def test_subscriber_connects_external_publisher(
    component: Components, name_server: NameServer, names: NameClient
) -> None:
    """The publisher of another domain starts later, and restarts; so does the name server."""
    received: list[tuple[str, int]] = []
    component("reader").subscribe(
        EVENTS, lambda name, level: received.append((name, level)), "fast_tcp:/other/Events:o"
    )
    wait_until(lambda: names.query("/reader/Events:i"))

    def start(domain: str) -> tuple[YarpComponent, Callable[..., None]]:
        other = YarpComponent("other", domain, (LOOPBACK, name_server.number))
        return other, other.publisher(EVENTS)

    other, publish = start("test-first")
    wait_until(lambda: publish("first", 1) or ("first", 1) in received)
    other.ports.close()
    other, publish = start("test-second")
    wait_until(lambda: publish("second", 2) or ("second", 2) in received)
    name_server.close()
    again = NameServer((LOOPBACK, name_server.number))
    try:
        wait_until(lambda: names.query("/reader/Events:i"))
        wait_until(lambda: names.query("/other/Events:o"))
        other.ports.close()
        other, publish = start("test-third")
        wait_until(lambda: publish("third", 3) or ("third", 3) in received)
    finally:
        other.ports.close()
        again.close()


def test_subscriber_accepts_plain_data(component: Components, names: NameClient) -> None:
    received: list[object] = []
    own = component()
    own.subscribe(EVENTS, lambda *values: received.append(values))
    own.subscribe(SCAN, lambda meters: received.append(meters.tolist()))
    own.subscribe(POSE, received.append)
    for name, text in (
        ("Events", "event bump 3"),
        ("Events", "plain 4"),
        ("Scan", "1 2.5"),
        ("PosePub", "1 2 map"),
    ):
        assert rpc(names, f"/own/{name}:i", text) == ""
    wait_until(lambda: len(received) == 4)
    assert received == [("bump", 3), ("plain", 4), [1.0, 2.5], Pose(1.0, 2.0, "map")]
    rpc(names, "/own/Events:i", "event 5 bump")
    assert own.statistics.of("Events", "event").malformed == 1


def test_addresses_name_ports(component: Components, names: NameClient) -> None:
    addresses = {("yarp", "Robot"): "/robot/arm", ("yarp", "Events"): "/robot/events:o"}
    own = component(addresses=addresses)
    own.serve(ROBOT, HANDLERS)
    own.publisher(EVENTS)
    assert rpc(names, "/robot/arm", "add 1 2") == "[ok] 3"
    wait_until(lambda: names.query("/robot/events:o"))
    other = component("other")
    assert other.caller(ROBOT, "add")(2, 2) == 4


def test_ports_are_unregistered(component: Components, names: NameClient) -> None:
    own = component()
    own.serve(ROBOT, HANDLERS)
    wait_until(lambda: names.query("/own/Robot/rpc:i"))
    own.ports.close()
    assert names.query("/own/Robot/rpc:i") is None


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        (
            "port",
            "5",
            r"unknown setting `yarp.port`; known: host, layout, layout.PORT, name_server",
        ),
        ("layout", "ros", r"`yarp.layout=ros`: write one of yarp, fields, thrift"),
        ("layout.Scan", "", r"`yarp.layout.Scan=`: write one of yarp, fields, thrift"),
        ("version", "5", r"`yarp.version=5`: write 3 or 4"),
        ("start_name_server", "yes", "write true or false"),
        ("name_server", "x", "write HOST:PORT"),
    ],
)
def test_wrong_settings_are_reported(
    component: Components, key: str, value: str, message: str
) -> None:
    with pytest.raises(MiddlewareError, match=message):
        component(transport_settings={("yarp", key): value})


def test_wrong_addresses_are_reported(component: Components) -> None:
    own = component(addresses={("yarp", "Robot"): "arm", ("yarp", "Events"): "/e@256.0.0.1:5"})
    with pytest.raises(MiddlewareError, match=r"own\.Robot: `arm` is no address of YARP"):
        own.serve(ROBOT, HANDLERS)
    with pytest.raises(MiddlewareError, match=r"own\.Events: YARP cannot listen at 256"):
        own.publisher(EVENTS)
    with pytest.raises(MiddlewareError, match=r"own\.Scan: `laser` is no address of YARP"):
        own.subscribe(SCAN, lambda _: None, "laser")


def test_component_starts_the_name_server(
    component: Components, name_server: NameServer, names: NameClient
) -> None:
    name_server.close()
    own = component(transport_settings={("yarp", "start_name_server"): "true"})
    own.serve(ROBOT, HANDLERS)
    wait_until(lambda: names.query("/own/Robot/rpc:i"))


def test_components_of_yarp_4(component: Components) -> None:
    settings = {("yarp", "version"): "4"}
    component("server", transport_settings=settings).serve(
        ROBOT, {"plan": lambda goal: np.array([goal.x, goal.y])}
    )
    call = component("client", transport_settings=settings).caller(ROBOT, "plan")
    assert call(Pose(0.5, 1.5)).tolist() == [0.5, 1.5]

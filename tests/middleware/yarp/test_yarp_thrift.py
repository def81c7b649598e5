"""Services and topics in the wire form of yarpidl_thrift."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path as Path_
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.generate.plan import plan
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.bottle import messages
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.errors import MalformedMessage, RemoteError
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from tests.generate.golden_cases import component as component_of
from tests.middleware.yarp.conftest import LOOPBACK, YarpComponent
from tests.middleware.yarp.test_yarp_transport import rpc
from tests.middleware.yarp.test_yarp_wire import Recorder
from tests.middleware.yarp.thrift_types import DEMO, PATHS, Color, DemoHandlers, Path, Point
from tests.support.waiting import wait_until

PEER = Path_(__file__).parent / "thrift_peer" / "demo.thrift"
Components = Callable[..., YarpComponent]
START = Point(1.0, 2.0, "s")
PATH = Path(
    [Point(1.5, 3.0, "p"), Point(2.5, 5.0, "p")],
    {"a": 1, "b": 2},
    True,
    np.array([3, 4], np.int16),
    Color.BLUE,
    START,
)
PATH_TEXT = "((1.5 3.0 p) (2.5 5.0 p)) ((a 1) (b 2)) [ok] (3 4) 6 1.0 2.0 s"
"""As code of yarpidl_thrift 3.5 writes it."""

CALLS = [
    ("add", (1, 2), "[add] 1 2", 3, "3"),
    ("set_flag", (False,), "[set] flag [fail]", True, "[ok]"),
    ("place", (), "place", 7, "7"),
    ("make_path", (START, [1.5]), "[make] [path] 1.0 2.0 s (1.5)", PATH, PATH_TEXT),
    ("measure_path", (PATH,), f"measure [path] {PATH_TEXT}", 5, "5"),
    ("reset", (), "reset", None, ""),
    ("get_long_method_name", ("hey",), "[get] [long] method [name] hey", "a b", '"a b"'),
    ("next_number", (1 << 40,), "[next] number 1099511627776", 5, "5"),
    ("negated", (-3,), "negated -3", 3, "3"),
    ("reversed", (b"ab",), "reversed {97 98}", np.array([98, 97], np.uint8), "{98 97}"),
    ("names", (), "names", ["a", "b"], "(a b)"),
    ("table", (), "table", {"k": Point(1.0, 2.0, "z")}, "((k (1.0 2.0 z)))"),
    ("paint", (Color.GREEN,), "paint 5", Color.BLUE, "6"),
    ("colors", ([Color.RED, Color.BLUE],), "colors (0 6)", [Color.RED], "(0)"),
]


@pytest.mark.parametrize(("name", "arguments", "request_", "result", "reply"), CALLS)
def test_thrift_messages(
    name: str, arguments: tuple[Any, ...], request_: str, result: object, reply: str
) -> None:
    operation, layout = DEMO.operation(name), Layout.THRIFT
    request = messages.request_encoder(operation, layout)(arguments)
    assert write_text(request) == request_
    behind = len(messages.request_words(operation, layout))
    decoded = messages.request_decoder(operation, layout)(request[behind:])
    assert messages.request_encoder(operation, layout)(decoded) == request
    assert write_text(messages.reply_encoder(operation, layout)(result)) == reply
    decode = messages.reply_decoder(operation, layout, external=True)
    np.testing.assert_equal(decode(read_text(reply)), result)


def test_definition_of_the_thrift_peer_gives_its_interface(tmp_path: Path_) -> None:
    text = f'import "{PEER.name}";\nComponent x {{ Communications {{ requires Demo; }};'
    (tmp_path / PEER.name).write_bytes(PEER.read_bytes())
    (tmp_path / "x.cdsl").write_text(f"{text} language Python; }};\n")
    (file,) = (f for f in plan(component_of(tmp_path / "x.cdsl")) if f.path.endswith("faces.py"))
    module = ModuleType("generated_of_thrift_peer")
    exec(compile(file.text, file.path, "exec", dont_inherit=True), vars(module))
    interface = vars(module)["DEMO"]
    assert (interface.hash, interface.style) == (DEMO.hash, "thrift")
    assert [o.defaults for o in interface.operations] == [o.defaults for o in DEMO.operations]


@pytest.mark.parametrize(
    ("request_", "arguments"),
    [("0.0 2.0 p", (Point(0.0, 2.0, "p"), 5, "x")), ("0.0 2.0 p 6", (Point(0.0, 2.0, "p"), 6, "x")),
     ("0.0 2.0 p 7 y", (Point(0.0, 2.0, "p"), 7, "y"))],
)  # fmt: skip
def test_thrift_request_may_lack_arguments_with_defaults(
    request_: str, arguments: tuple[Any, ...]
) -> None:
    inputs = {"start": Point, "count": rt.Int, "name": rt.String}
    operation = rt.Operation("go", inputs=inputs, defaults={"count": 5, "name": "x"})
    assert messages.request_decoder(operation, Layout.THRIFT)(read_text(request_)) == arguments
    with pytest.raises(
        MalformedMessage,
        match=r"has 2 values \(float64, float64\), but should have: start Point, count",
    ):
        messages.request_decoder(operation, Layout.THRIFT)(read_text("0.0 2.0"))


@pytest.mark.parametrize(
    ("name", "reply", "fails"),
    [
        ("add", "[fail]", True),
        ("add", '[fail] "no sum" remote', True),
        ("add", "3", False),
        ("set_flag", "[fail]", False),
        ("set_flag", '[fail] "no flag" remote', True),
    ],
)
def test_thrift_failures(name: str, reply: str, fails: bool) -> None:
    operation = DEMO.operation(name)
    bottle = read_text(reply)
    assert messages.is_failure(bottle, operation, Layout.THRIFT, external=True) is fails


@pytest.mark.parametrize(
    ("request_", "reply"),
    [
        ("add 1 2", "3"),
        ("[add] 1 2", "3"),
        ("[set] [flag] [ok]", "[ok]"),
        ("set_flag [fail]", "[fail]"),
        ("set flag true", "[ok]"),
        ("[go] [home] [now] 7", "[done]"),
        ("make path 1.0 2.0 s (1.5 2.5)", PATH_TEXT),
        (f"measure_path {PATH_TEXT}", "2126"),
        ("reset", ""),
        ("get long method name hey", '"hey!"'),
        ("get long method name", '"x!"'),
        (
            "add 1",
            '[fail] "malformed message: message, byte 0: has 1 values (int32), but should have: ',
        ),
        ("fly 1", "[fail] "),
        ("help", '[many] ("*** Available commands:" "add a b" "set_flag on" '),
    ],
)
def test_served_thrift_port_replies_as_yarpidl_thrift(
    component: Components, names: NameClient, request_: str, reply: str
) -> None:
    component("server").serve(DEMO, DemoHandlers().handlers())  # type: ignore[arg-type]
    found = rpc(names, "/server/Demo/rpc:i", request_)
    assert found == reply or (reply.startswith("[") and found.startswith(reply))


def test_components_call_each_other_in_thrift_form(component: Components) -> None:
    served = DemoHandlers()
    component("server").serve(DEMO, served.handlers())  # type: ignore[arg-type]
    client = component("client")
    check_calls(client, served)
    with pytest.raises(RemoteError, match="failed: KeyError: 'a'"):
        client.caller(DEMO, "measure_path")(Path())


def check_calls(client: YarpComponent, served: DemoHandlers | None, *external: str) -> None:
    """Call every operation of a server that is `DemoHandlers`, or the peer in C++."""

    def call(name: str) -> Callable[..., Any]:
        return client.caller(DEMO, name, *external)

    assert call("add")(1, 2) == 3
    assert call("set_flag")(True) is True
    assert call("set_flag")(False) is False
    call("go_home_now")(7)
    wait_until(lambda: call("place")() == 7)
    assert served is None or served.place == 7
    assert call("make_path")(START, [1.5, 2.5]) == PATH
    assert call("measure_path")(PATH) == 2126
    assert call("reset")() is None
    assert call("get_long_method_name")("hey") == "hey!"
    assert call("next_number")(1 << 40) == (1 << 40) + 1
    assert call("twice")(0.25) == 0.5
    assert call("negated")(-3) == 3
    assert call("half")(-300) == -150
    assert call("reversed")(b"xyz").tobytes() == b"zyx"
    assert call("names")() == ["a", "b"]
    assert call("table")() == {"k": Point(1.0, 2.0, "z")}
    assert call("paint")(Color.GREEN) is Color.GREEN
    assert call("colors")([Color.RED, Color.BLUE]) == [Color.RED, Color.BLUE]


def test_thrift_struct_on_a_topic_is_flat(component: Components, names: NameClient) -> None:
    recorder = Recorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)
    names.register("/reader", LOOPBACK, reader.number)
    received: list[Path] = []
    component("other").subscribe(PATHS, received.append)
    publish = component().publisher(PATHS, "/reader")
    wait_until(lambda: publish(PATH) or (recorder.received and received))
    assert recorder.received[0] == PATH_TEXT
    assert received[0] == PATH
    reader.close()


PREFIXES = rt.Interface(
    "demo::Prefixes",
    rt.Operation("set", inputs={"what": rt.String, "on": rt.Bool}, returns=rt.String),
    rt.Operation("set_flag", inputs={"on": rt.Bool}, returns=rt.String),
)


def test_thrift_name_that_begins_another(component: Components, names: NameClient) -> None:
    settings = {("yarp", "layout.Prefixes"): "thrift"}
    component("server", transport_settings=settings).serve(
        PREFIXES, {"set": lambda what, on: f"set {what}", "set_flag": lambda on: "set_flag"}
    )
    port = "/server/Prefixes/rpc:i"
    assert rpc(names, port, "[set] [flag] [ok]") == "set_flag"
    assert rpc(names, port, "set flag true") == "set_flag"
    assert rpc(names, port, "[set] door [ok]") == '"set door"'


def test_malformed_reply_of_a_thrift_server(component: Components, names: NameClient) -> None:
    recorder = Recorder()
    recorder.reply = ["what"]
    plain = YarpPort("/plain", (LOOPBACK, 0), recorder)
    names.register("/plain", LOOPBACK, plain.number)
    with pytest.raises(MalformedMessage, match=r"the reply of plain\.Demo\.add"):
        component().caller(DEMO, "add", "/plain")(1, 2)
    recorder.reply = read_text("[fail]")
    with pytest.raises(RemoteError, match=r"plain\.Demo\.add failed: it reported a failure"):
        component("second").caller(DEMO, "add", "/plain")(1, 2)
    plain.close()

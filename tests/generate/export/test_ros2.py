"""`--to ros2`: parsed with rosbags, and compared with the bytes of the runtime."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from robocomp_dsl.generate.export import export
from robocomp_dsl.generate.exports import ros2_names
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.runtime.codec.codec import compile_decoder, decode, encode
from robocomp_dsl.runtime.component import component_interface as rt
from robocomp_dsl.runtime.data.schema import schema_of
from tests.generate.export import exported, random_idsl

# The rules of rosidl_adapter's parser.
PACKAGE = MEMBER = re.compile(r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*")
MESSAGE = re.compile(r"[A-Z][A-Za-z0-9]*")
CONSTANT = re.compile(r"[A-Z]([A-Z0-9_]?[A-Z0-9]+)*")


def parsed(files: Iterable[OutputFile]) -> dict[str, Any]:
    """All types of the messages and services, each name within the rules."""
    found: dict[str, Any] = {}
    for file in files:
        package, _, rest = file.path.partition("/")
        assert PACKAGE.fullmatch(package)
        stem = Path(rest).stem
        if rest.startswith("msg/"):
            found |= get_types_from_msg(file.text, f"{package}/msg/{stem}")
        elif rest.startswith("srv/"):
            request, response = re.split("(?m)^---\n", file.text)
            # The parser reads the two parts of a service as messages.
            found |= get_types_from_msg(request, f"{package}/msg/{stem}_Request")
            found |= get_types_from_msg(response, f"{package}/msg/{stem}_Response")
        if rest.startswith(("msg/", "srv/")):
            assert MESSAGE.fullmatch(stem)
    for constants, members in found.values():
        for name, _, _ in constants:
            assert CONSTANT.fullmatch(name)
        for name, _ in members:
            assert MEMBER.fullmatch(name)
            assert name not in ros2_names.RESERVED_WORDS
        for names in ([n for n, *_ in constants], [n for n, _ in members]):
            assert len({*names}) == len(names)
    return found


def registered(types: dict[str, Any]) -> Any:
    """A store of only these types; it refuses a mention of one that is not there."""
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    for name in types:
        store.generate_msgdef(name, ros_version=2)
    return store


def test_ros2_export_of_shipped_interfaces_is_parsed() -> None:
    everything: dict[str, Any] = {}
    for name in exported.SHIPPED:
        files = export(exported.modules(INTERFACES / name), "ros2")
        assert not files.findings
        paths = [file.path.lower() for file in files.files]
        assert len({*paths}) == len(paths)
        everything |= parsed(files.files)
    registered(everything)
    assert "robocomp_laser/msg/TLaserData" in everything
    assert "robocomp_laser/msg/LaserGetLaserData_Response" in everything


@settings(max_examples=60)
@given(texts=random_idsl.texts())
def test_ros2_export_of_random_interface_is_parsed(texts: dict[str, str]) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in texts.items():
            (folder / file).write_text(text)
        files = export(exported.modules(folder / "Text.idsl"), "ros2")
        paths = [written.path.lower() for written in files.files]
        assert len({*paths}) == len(paths)
        registered(parsed(files.files))


@pytest.mark.parametrize(
    ("name", "member", "message"),
    [
        ("getLaserData", "get_laser_data", "GetLaserData"),
        ("HTTPServer2Go", "http_server2_go", "HTTPServer2Go"),
        ("RoboCompLaser", "robocomp_laser", "RoboCompLaser"),
        ("_x__y_", "x_y", "XY"),
        ("__", "n", "N"),
        ("_1", "n1", "N1"),
        ("class", "class_value", "Class"),
        ("header", "header", "HeaderData"),
    ],
)
def test_ros2_names_follow_conventions(name: str, member: str, message: str) -> None:
    assert (ros2_names.member_name(name), ros2_names.message_name(name)) == (member, message)


def test_ros2_message_has_bytes_of_runtime() -> None:
    """Enum, sequences, long and double, in both directions."""
    files = export(exported.modules(INTERFACES / "Component.idsl"), "ros2")
    store = registered(parsed(files.files))
    ports = [rt.PortInfo("implements", "Laser", "M::Laser", "zenoh", ["a", "b"])]
    ours = rt.ComponentInfo(
        name="é", pid=-7, state=rt.LifeState.Emergency, uptime=0.5, ports=ports, reason="x"
    )
    kind = "robocomp_component/msg/ComponentInfo"
    theirs = store.deserialize_cdr(encode(ours), kind)
    assert (theirs.name, theirs.pid, theirs.uptime, theirs.reason) == ("é", -7, 0.5, "x")
    assert theirs.state.value == rt.LifeState.Emergency == theirs.state.EMERGENCY
    assert (theirs.ports[0].declared, theirs.ports[0].peers) == ("M::Laser", ["a", "b"])
    assert decode(rt.ComponentInfo, bytes(store.serialize_cdr(theirs, kind))) == ours


def test_ros2_dictionary_has_bytes_of_its_entries() -> None:
    files = export(exported.modules(INTERFACES / "Component.idsl"), "ros2")
    store = registered(parsed(files.files))
    entry = store.types["robocomp_component/msg/ValuesEntry"]
    values = store.types["robocomp_component/msg/Values"](entries=[entry("a", "1"), entry("b", "")])
    written = bytes(store.serialize_cdr(values, values.__msgtype__))
    read = compile_decoder((("", schema_of(rt.Values)),), result=True)(written)
    assert read == {"a": "1", "b": ""}

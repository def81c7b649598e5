"""The options of a component that name ports, peers and qualities of service."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.component.settings import (
    InvalidSetting,
    RunSettings,
    parse_connections,
    parse_peer,
    parse_prefix,
    parse_qos,
    parse_remaps,
)
from robocomp_dsl.runtime.connection.endpoint import Qos


@pytest.mark.parametrize("text", ["laser", "=base", "laser=", "laser=a b", "laser=*"])
def test_parse_connections_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_connections([text])


@pytest.mark.parametrize(
    "text", ["laser", "laser=fast", "laser=depth=0", "laser=depth=x", "laser=priority=urgent"]
)
def test_parse_qos_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_qos([text])


def test_parse_qos_reads_settings() -> None:
    qualities = parse_qos(["laser=best_effort,depth=1", "laser=priority=high,deadline=40"])
    assert qualities == {"laser": Qos(False, 1, "high", 0.04)}


@pytest.mark.parametrize(
    ("prefix", "wires", "remaps", "peers"),
    [
        ("", (), {}, ()),
        ("left", (), {}, ()),
        ("", ("base",), {}, ("base",)),
        ("left", ("base",), {}, ("left/base",)),
        ("left", ("base.Front",), {}, ("left/base.Front",)),
        (
            "left",
            ("/base", "hand/base", "/right/base"),
            {},
            ("base", "left/hand/base", "right/base"),
        ),
        ("left", (), {"Laser": "scan"}, ("*.scan",)),
        ("left", ("base", "/b.Front"), {"Laser": "scan"}, ("left/base.scan", "b.Front")),
    ],
)
def test_run_settings_resolve_peers_under_prefix(
    prefix: str, wires: tuple[str, ...], remaps: dict[str, str], peers: tuple[str, ...]
) -> None:
    settings = RunSettings(
        prefix=prefix, connections={"Laser": wires} if wires else {}, remaps=remaps
    )
    assert settings.peers_of("Laser") == peers


@pytest.mark.parametrize(
    ("text", "prefix"), [("left", "left"), ("/left/hand/", "left/hand"), ("/", ""), ("", "")]
)
def test_parse_prefix_normalizes_slashes(text: str, prefix: str) -> None:
    assert parse_prefix(text) == prefix


@pytest.mark.parametrize("text", ["a//b", "a b", "*", "a/*", "/".join("abcdefghi"), "é"])
def test_parse_prefix_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_prefix(text)


@pytest.mark.parametrize("text", ["", "/", "//a", "a/", "a//b", "*", "*.x", "../a"])
def test_parse_peer_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_peer(text)


@pytest.mark.parametrize("text", ["", "A=", "=x", "A=a/b", "A=*", "A=1", "A"])
def test_parse_remaps_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_remaps([text])

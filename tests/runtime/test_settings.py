"""The options of a component that name ports, peers and qualities of service."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.settings import (
    RunSettings,
    parse_connections,
    parse_peer,
    parse_prefix,
    parse_remaps,
)


@pytest.mark.parametrize("text", ["laser", "=base", "laser=", "laser=a b", "laser=*"])
def test_parse_connections_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_connections([text])


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


def test_address_of_renamed_port_is_known_by_its_new_name() -> None:
    settings = RunSettings(
        remaps={"Laser": "front", "Speech": "voice"},
        addresses={("ice", "Laser"): "tcp -p 1", ("ice", "Speech"): "tcp -p 2"},
    )
    assert settings.visible_addresses(["Laser"]) == {
        ("ice", "front"): "tcp -p 1",
        ("ice", "Speech"): "tcp -p 2",
    }

"""The value of `--monitors`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime.component.settings import InvalidSetting
from robocomp_dsl.runtime.connection.monitor_settings import MonitorSettings
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors

ENTRY = {"port": "Target", "at": "receiver", "peer": "face.TargetPub"}
MONITOR = {"file": "/m.py", "class": "Face"}


def test_monitor_settings_are_parsed_from_json_and_from_a_file(tmp_path: Path) -> None:
    monitor = MONITOR | {"parameters": {"certainty": 0.8}, "on_failure": "close"}
    text = json.dumps([ENTRY | {"when": "e_face", "monitors": [monitor]}])
    (connection,) = parse_monitors(text)
    assert (connection.port, connection.peer, connection.position) == (
        "Target",
        "face.TargetPub",
        "receiver",
    )
    assert connection.constraint is not None
    assert connection.constraint.events == ("e_face",)
    assert connection.monitors == (
        MonitorSettings(Path("/m.py"), "Face", (("certainty", 0.8),), closes_on_failure=True),
    )
    (tmp_path / "m.json").write_text(text)
    (from_file,) = parse_monitors(f"@{tmp_path / 'm.json'}")
    assert from_file.monitors == connection.monitors


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ("[", "--monitors is no JSON"),
        ("@/nowhere/m.json", "cannot read /nowhere/m.json"),
        ({}, "--monitors is a list of connections"),
        ([3], "connection 1 is an object, not 3"),
        ([ENTRY, {"port": "Target"}], "connection 2 needs `peer`"),
        ([ENTRY | {"peers": "a.B"}], "connection 1 has no `peers`; its items: port, peer"),
        ([ENTRY | {"port": 3}], "connection 1: `port` is a text"),
        ([ENTRY | {"monitors": {}}], "connection 1: `monitors` is a list"),
        ([ENTRY | {"peer": "face"}], "`peer` is component.Port, not `face`"),
        ([ENTRY | {"at": "middle"}], "`at` is one of receiver, sender, identify, not `middle`"),
        ([ENTRY | {"at": "sender", "when": "e"}], "`when` needs `at` receiver"),
        ([ENTRY | {"when": "e_a e_b"}], "`when e_a e_b`, column 5: `and` or `or` is missing"),
        ([ENTRY, ENTRY], "Target with face.TargetPub occurs twice"),
        ([ENTRY, ENTRY | {"peer": "b.P", "when": "e"}], "some connections into Target have `when`"),
        ([ENTRY | {"monitors": [MONITOR] * 17}], "17 monitors; at most 16"),
        ([ENTRY | {"monitors": [{}]}], "connection 1, monitor 1 needs `file`"),
        ([ENTRY | {"monitors": [MONITOR | {"on_failure": "stop"}]}], "is bypass or close"),
        ([ENTRY | {"monitors": [MONITOR | {"parameters": {"a": []}}]}], "parameter `a` is a bool"),
    ],
)
def test_monitor_settings_that_are_invalid(entries: Any, message: str) -> None:
    text = entries if isinstance(entries, str) else json.dumps(entries)
    with pytest.raises(InvalidSetting) as caught:
        parse_monitors(text)
    assert message in str(caught.value)

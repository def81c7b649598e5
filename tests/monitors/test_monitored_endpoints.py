"""The endpoints of which a monitored subscribed port consists, as a transport would get them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from robocomp_dsl.runtime.clock import WallClock
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.settings import ExternalPeer, RunSettings
from robocomp_dsl.runtime.connection.component_monitors import ComponentMonitors
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.monitored_ports import MonitoredPorts
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors
from tests.middleware.probe_types import NEWS
from tests.monitors.components import Listener

SCAN = '{"port": "News", "at": "receiver", "peer": "scan.News"WHEN}'
NEAR = '{"port": "News", "at": "receiver", "peer": "near.News"WHEN}'


class EndpointList:
    """Ports that only note their endpoints: an external program is needed to open them."""

    def __init__(self) -> None:
        self.endpoints: list[Endpoint] = []

    def subscribe(self, at: Endpoint, _handlers: Mapping[str, Any], _group: CallbackGroup) -> None:
        self.endpoints.append(at)


@pytest.mark.parametrize(
    ("entries", "condition", "expected"),
    [
        (
            (NEAR,),
            "",
            [
                ("News from near:News", ("near.News",), (), ("zenoh", "ice")),
                ("News", ("far",), ("scan", "other"), ("zenoh", "ice")),
            ],
        ),
        (
            (SCAN,),
            "",
            [
                ("News", ("scan.News",), ("scan",), ("ice",)),
                ("News", ("near", "far"), ("other",), ("zenoh", "ice")),
            ],
        ),
        (
            (SCAN, NEAR),
            "e_scan",
            [
                ("News", ("scan.News",), ("scan",), ("ice",)),
                ("News from near:News", ("near.News",), (), ("zenoh", "ice")),
            ],
        ),
    ],
)
def test_monitored_endpoints_divide_the_peers(
    entries: tuple[str, ...],
    condition: str,
    expected: list[tuple[str, tuple[str, ...], tuple[str, ...], tuple[str, ...]]],
) -> None:
    when = f', "when": "{condition}"' if condition else ""
    text = ", ".join(entry.replace("WHEN", when) for entry in entries)
    peers = {"News": (ExternalPeer("scan", "ice", "x"), ExternalPeer("other", "ice", "y"))}
    settings = RunSettings(monitors=parse_monitors(f"[{text}]"), external=peers)
    monitors = ComponentMonitors(Listener.SPEC, settings)
    monitors.create(WallClock())
    records = settings.external_records("News", "publisher", NEWS.name)
    at = Endpoint(
        NEWS,
        "listener",
        "News",
        ("near", "far"),
        middlewares=("zenoh", "ice"),
        external=records,
    )
    inner = EndpointList()
    ports = MonitoredPorts(inner, monitors)  # type: ignore[arg-type] - subscribes only
    ports.subscribe(at, {"announced": print}, CallbackGroup())
    found = [
        (end.port, end.peers, tuple(e.component for e in end.external), end.middlewares)
        for end in inner.endpoints
    ]
    assert found == expected

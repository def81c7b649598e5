"""Connections between external programs, which rcdeploy makes and keeps."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from robocomp_dsl.deploy.external_connection import CONNECTED, WAITING
from robocomp_dsl.deploy.supervisor import external_connections
from robocomp_dsl.deploy.supervisor.external_connections import ExternalConnections, open_connector
from robocomp_dsl.deploy.supervisor.run_options import Outcome
from robocomp_dsl.model.deployment import ExternalConnection
from robocomp_dsl.runtime.middleware.external_connector import ConnectorError
from robocomp_dsl.runtime.middleware.yarp.connector import YarpConnector
from robocomp_dsl.runtime.middleware.yarp.connector import open_connector as of_yarp
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from robocomp_dsl.source import Source
from tests.deploy.supervisor_run import SupervisorRun, stop
from tests.middleware.yarp.conftest import (
    LOOPBACK,
    SCAN,
    YarpComponent,
    component,
    domain,
    name_server,
    names,
)
from tests.support.waiting import wait_until

__all__ = ["component", "domain", "name_server", "names"]
Components = Callable[..., YarpComponent]
SOURCE, TARGET = "/camera/Scan:o", "/view/Scan:i"
LINK = ExternalConnection("yarp", SOURCE, TARGET, "fast_tcp", Source(Path("x"), "").file_span)


class ConnectionsRun:
    """`ExternalConnections` in an event loop of another thread, and what they log."""

    def __init__(self, *links: ExternalConnection, names: NameClient) -> None:
        self.log: list[tuple[str, str]] = []
        self.connections = ExternalConnections(
            links, lambda *record: self.log.append(record), lambda _: YarpConnector(names)
        )
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever)
        self._thread.start()
        asyncio.run_coroutine_threadsafe(self._start(), self._loop).result()

    async def _start(self) -> None:
        self.connections.start()

    def states(self) -> list[tuple[str, str]]:
        return [(status.state, status.reason) for status in self.connections.statuses()]

    def logged(self, text: str) -> bool:
        return any(text in record[0] for record in self.log)

    def close(self) -> None:
        self.connections.close()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()


@pytest.fixture
def keep(names: NameClient) -> Iterator[Callable[..., ConnectionsRun]]:
    """Keeps connections until the end of the test."""
    opened: list[ConnectionsRun] = []

    def open_run(*links: ExternalConnection) -> ConnectionsRun:
        opened.append(ConnectionsRun(*links, names=names))
        return opened[-1]

    yield open_run
    for each in opened:
        each.close()


def test_external_connection_is_made_when_both_ports_exist_and_carries_data(
    component: Components, keep: Callable[..., ConnectionsRun]
) -> None:
    run = keep(LINK)
    wait_until(lambda: run.states() == [(WAITING, f"the name server knows no port {SOURCE}")])
    publish = component("camera").publisher(SCAN)
    wait_until(lambda: run.states() == [(WAITING, f"the name server knows no port {TARGET}")])
    received: list[list[float]] = []
    component("view").subscribe(SCAN, lambda scan: received.append(list(scan)))
    wait_until(lambda: run.states() == [(CONNECTED, "")])
    publish([1.0, 2.0])
    wait_until(lambda: received == [[1.0, 2.0]])
    wait_until(lambda: run.logged(f"connected {SOURCE} -> {TARGET} over yarp (fast_tcp)"))


def test_external_connection_is_made_again_after_a_program_restarts(
    component: Components, keep: Callable[..., ConnectionsRun]
) -> None:
    camera = component("camera")
    camera.publisher(SCAN)
    received: list[list[float]] = []
    component("view").subscribe(SCAN, lambda scan: received.append(list(scan)))
    run = keep(LINK)
    wait_until(lambda: run.states() == [(CONNECTED, "")])
    camera.ports.close()
    wait_until(lambda: run.states()[0][0] == WAITING)
    wait_until(lambda: run.logged(f"lost {SOURCE} -> {TARGET}"))
    publish = component("camera").publisher(SCAN)
    wait_until(lambda: run.states() == [(CONNECTED, "")])
    publish([3.0])
    wait_until(lambda: received == [[3.0]])


def test_external_connections_remove_at_the_end_only_their_own(
    component: Components, keep: Callable[..., ConnectionsRun], names: NameClient
) -> None:
    camera = component("camera")
    camera.publisher(SCAN)
    for name in ("view", "record"):
        component(name).subscribe(SCAN, lambda scan: None)
    other = "/record/Scan:i"
    wait_until(lambda: all(names.query(name) for name in (SOURCE, TARGET, other)))
    YarpConnector(names).connect(SOURCE, other, "")
    run = keep(LINK, ExternalConnection("yarp", SOURCE, other, "", LINK.span))
    wait_until(lambda: run.states() == [(CONNECTED, "")] * 2)
    outputs = camera.outputs("Scan")
    assert sorted(outputs()) == [other, TARGET]
    run.connections.close()
    assert outputs() == [other]


def test_external_connection_that_waits_is_logged_once_with_its_reason(
    keep: Callable[..., ConnectionsRun], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external_connections, "REPORT_WAITING_S", 0.0)
    monkeypatch.setattr(external_connections, "PERIOD_S", 0.01)
    run = keep(LINK)
    rounds: list[object] = []

    def has_waited_for_three_rounds() -> bool:
        rounds.append(run.states())
        return len(rounds) > 3 and bool(run.log)

    wait_until(has_waited_for_three_rounds)
    text = f"cannot connect {SOURCE} -> {TARGET} over yarp (fast_tcp) yet"
    assert run.log == [(f"{text}: the name server knows no port {SOURCE}", "WARNING")]


def test_connector_tells_why_it_cannot_connect(
    component: Components, names: NameClient, name_server: NameServer
) -> None:
    connector = YarpConnector(names)
    component("camera").publisher(SCAN)
    component("view").subscribe(SCAN, lambda scan: None)
    wait_until(lambda: names.query(SOURCE) and names.query(TARGET))
    with pytest.raises(ConnectorError, match="Cannot connect to /view/Scan:i"):
        connector.connect(SOURCE, TARGET, "pigeon")
    with pytest.raises(ConnectorError, match="knows no port /nobody"):
        connector.connect(SOURCE, "/nobody", "tcp")
    with pytest.raises(ConnectorError, match="/view/Scan:i does not write"):
        connector.connect(TARGET, SOURCE, "tcp")
    names.register("/dead", LOOPBACK, 1)
    with pytest.raises(ConnectorError, match="/dead does not answer: Connection refused"):
        connector.connected("/dead", frozenset({TARGET}))
    name_server.close()
    with pytest.raises(ConnectorError, match="the name server cannot be reached"):
        connector.connected(SOURCE, frozenset({TARGET}))


def test_open_connector_names_what_is_wrong(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("YARP_CONFIG_HOME", str(tmp_path))
    (tmp_path / "yarp.conf").write_text("127.0.0.1 1 yarp\n")
    assert isinstance(open_connector("yarp"), type(of_yarp()))
    with pytest.raises(ConnectorError, match=r"127\.0\.0\.1:1"):
        open_connector("yarp").connected("/a", frozenset({"/b"}))
    with pytest.raises(ConnectorError, match="`local` cannot connect programs"):
        open_connector("local")


def test_deployment_of_external_connections_only_runs_until_it_is_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external_connections, "REPORT_WAITING_S", 0.0)
    monkeypatch.setenv("YARP_CONFIG_HOME", str(tmp_path))
    (tmp_path / "yarp.conf").write_text(f"{LOOPBACK} 1 yarp\n")
    run = SupervisorRun(tmp_path)
    run.plan = replace(run.plan, external_connections=(LINK,))
    run.on(f"cannot connect {SOURCE} -> {TARGET}", stop)
    assert run.run() == Outcome(0, "test")
    assert "the name server cannot be reached" in run.texts("rcdeploy")[0]

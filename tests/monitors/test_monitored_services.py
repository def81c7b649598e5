"""Monitors and arbitration of services: queries and commands, in components that run."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.codec.failures import decode_failure, encode_failure
from robocomp_dsl.runtime.errors import (
    CallRejected,
    EncodeError,
    NoServer,
    RejectedByReceiver,
    RemoteError,
)
from tests.middleware.probe_types import PROBE
from tests.monitors.components import Caller, Deployment, Server
from tests.monitors.manual_clock import ManualClock
from tests.support.waiting import wait_until

SMALL = """
    class Small(Monitor):
        def accept_add(self, a: int, b: int) -> bool:
            return a < 10

        def update_add(self, a: int, b: int) -> tuple[int, int]:
            return a, -b

        def accept_note(self, text: str) -> bool:
            return text != "secret"

        def update_note(self, text: str) -> str:
            return text.upper()
    """
URGENT = """
    class Urgent(Monitor):
        def accept_note(self, text: str) -> bool:
            if text == "urgent":
                self.set_event("e_urgent", 5.0)
            return True
    """


def test_monitor_at_the_sender_rejects_and_changes_calls(deployment: Deployment) -> None:
    deployment.write(SMALL)
    entry = {"port": "Probe", "at": "sender", "peer": "server.Probe"}
    monitors = [entry | {"monitors": [deployment.monitor("Small")]}]
    server = deployment.start(Server, "server")
    caller = deployment.start(Caller, "caller", monitors, peers=("server",))
    proxy = caller.worker.probe_proxy
    assert proxy.wait_for_server(60)
    assert proxy.add(3, 1) == 2
    with pytest.raises(CallRejected, match=r"add .* between caller\.Probe and server\.Probe"):
        proxy.add(10, 1)
    with pytest.raises(EncodeError, match="b: takes an integer"):
        proxy.add(1, "2")  # type: ignore[arg-type] - the error of the caller, not of the monitor
    for text in ("a", "secret", "b"):
        proxy.note(text)
    wait_until(lambda: len(server.worker.notes) == 2)
    assert server.worker.notes == ["A", "B"]
    (status,) = caller.monitors.statuses()
    assert (status.passed, status.rejected, status.failures) == (3, 2, 0)


def test_monitor_at_the_server_knows_the_caller(deployment: Deployment) -> None:
    deployment.write(SMALL)
    entry = {"port": "Probe", "at": "receiver", "peer": "first.Probe"}
    monitors = [entry | {"monitors": [deployment.monitor("Small")]}]
    server = deployment.start(Server, "server", monitors)
    identify = [{"port": "Probe", "at": "identify", "peer": "server.Probe"}]
    first = deployment.start(Caller, "first", identify, peers=("server",))
    second = deployment.start(Caller, "second", peers=("server",))
    third = deployment.start(Caller, "third")
    proxies = [runner.worker.probe_proxy for runner in (first, second, third)]
    assert all(proxy.wait_for_server(60) for proxy in proxies)
    assert [proxy.add(3, 1) for proxy in proxies] == [2, 4, 4]
    with pytest.raises(CallRejected, match="add of the connection between server"):
        proxies[0].add(10, 1)
    assert proxies[1].add(10, 1) == 11
    (status,) = server.monitors.statuses()
    assert (status.passed, status.rejected) == (1, 1)


def test_arbitrated_service_takes_commands_of_the_winner(deployment: Deployment) -> None:
    deployment.write(URGENT)
    clock = ManualClock()
    entry = {"port": "Probe", "at": "receiver"}
    urgent = {
        "peer": "planner.Probe",
        "when": "e_urgent",
        "monitors": [deployment.monitor("Urgent")],
    }
    normal = {"peer": "user.Probe", "when": "not e_urgent"}
    server = deployment.start(Server, "server", [entry | urgent, entry | normal], clock=clock)
    identify = [{"port": "Probe", "at": "identify", "peer": "server.Probe"}]
    planner, user = (
        deployment.start(Caller, name, identify, peers=("server",)).worker.probe_proxy
        for name in ("planner", "user")
    )
    assert planner.wait_for_server(60)
    assert user.wait_for_server(60)

    def note(proxy: object, text: str, judged: int) -> None:
        proxy.note(text)
        statuses = server.monitors.statuses
        wait_until(lambda: sum(s.passed + s.rejected for s in statuses()) == judged)

    note(planner, "a", 1)
    note(user, "b", 2)
    note(planner, "urgent", 3)
    note(user, "c", 4)
    with pytest.raises(CallRejected, match="`when not e_urgent` is false"):
        user.add(1, 2)
    clock.time = 5.0
    note(user, "d", 6)
    assert server.worker.notes == ["b", "urgent", "d"]


def test_arbitrated_service_has_no_server_for_others(
    quick_deployment: Deployment, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = "robocomp_dsl.runtime.connection.peer_selection"
    monkeypatch.setattr(f"{module}.DISCOVERY_TIMEOUT_S", 0.05)
    entry = {"port": "Probe", "at": "receiver", "peer": "planner.Probe", "when": "true"}
    quick_deployment.start(Server, "server", [entry])
    for peers in ((), ("server",)):
        other = quick_deployment.start(Caller, f"other{len(peers)}", peers=peers)
        with pytest.raises(
            NoServer, match=r"server\.Probe is arbitrated: it accepts its connections"
        ):
            other.worker.probe_proxy.add(1, 2)


def test_rejected_call_of_a_handler_is_a_failure_of_that_handler() -> None:
    operation = PROBE.operation("add")
    for error, kind in (
        (RejectedByReceiver("no"), CallRejected),
        (CallRejected("no"), RemoteError),
    ):
        reply = encode_failure(operation, error)
        assert type(decode_failure(operation, "server.Probe", reply, 1.0)) is kind

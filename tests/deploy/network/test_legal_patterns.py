"""Everything that components and the operator may do works through two routers with access rules.

Nothing of it is denied: the rules of a deployment are complete.
"""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from tests.deploy.network.secured_deployment import CLOCK_APP, SecuredDeployment
from tests.deploy.rcdeploy_process import rcdeploy
from tests.support.waiting import wait_until


def test_components_of_two_hosts_use_all_patterns(
    site: SecuredDeployment, components: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Query, command, reliable and latched topic; then the operator's tools."""
    states: dict[str, str] = {}
    with site.routers() as routers:
        with (
            site.start("worker", monkeypatch) as worker,
            site.start("boss", monkeypatch) as boss,
        ):
            boss.until("boss calls the worker", "boss hears reliable news", "boss sees latched")
            worker.until("worker starts to dig")
            monitor = StateMonitor(site.domain)
            monitor.start(lambda name, _pid, state: states.update({name: state}))
            wait_until(lambda: states == {"boss": "compute", "worker": "compute"})
            _use_tools(site.domain, components)
            with DomainClient(site.domain) as client:
                client.component("worker").stop()
            assert worker.end() == 0
            wait_until(lambda: states["worker"] == "")
            monitor.close()
            boss.process.send_signal(signal.SIGTERM)
            assert boss.end() == 0
        for router in routers:
            router.process.send_signal(signal.SIGTERM)
            assert router.end() == 0
            assert not router.has("denied"), "\n".join(router.lines)


def _use_tools(domain: str, components: Path) -> None:
    interfaces = load_generated_interfaces(components / "boss")
    received: list[str] = []
    with DomainClient(domain) as client:
        assert client.operations(interfaces.JOB, "worker", "Job").twice(5) == 10
        client.subscribe(interfaces.NEWS, "worker", "News", {"news": received.append})
        worker = client.component("worker")
        worker.setParameters({"gain": "7"})
        assert {p.name: p.value for p in worker.getParameters()}["gain"] == "7"
        worker.setPeriod(50)
        ports = {port.name for port in client.describe("worker").ports}
        assert {"Job", "News", "State"} <= ports
        wait_until(lambda: received)
    assert received[0] == "reliable news"
    call = rcdeploy("call", "--domain", domain, "worker.Job.twice", "8")
    assert "16" in call.stdout, call.stderr
    echo = rcdeploy("echo", "--domain", domain, "worker.News", "-n", "1")
    assert "reliable news" in echo.stdout, echo.stderr


@pytest.mark.parametrize("kind", ["", "lockstep"], ids=["simulated clock", "lock-step"])
def test_components_of_two_hosts_share_simulated_time(
    components: Path, private_home: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    # In lock-step every message is a call, which cannot be latched.
    connection = "" if kind else "connect ticker.State -> boss.State {{ latched; }};"
    app = CLOCK_APP.replace("CLOCK_KIND", kind).replace("CONNECTION", connection)
    site = SecuredDeployment(components, app)
    with site.routers() as routers:
        with (
            site.start("ticker", monkeypatch) as ticker,
            site.start("lab/boss", monkeypatch) as boss,
        ):
            heard = ["boss hears reliable news"] + ([] if kind else ["boss sees latched state"])
            boss.until("boss calls the worker", *heard)
            ticker.until("worker starts to dig")
            for process in (boss, ticker):
                process.process.send_signal(signal.SIGTERM)
                assert process.end() == 0
        for router in routers:
            router.process.send_signal(signal.SIGTERM)
            assert router.end() == 0
            assert not router.has("denied"), "\n".join(router.lines)

"""The end of a router is not that of its components; and everything works again when it is back."""

from __future__ import annotations

import signal
from datetime import timedelta
from pathlib import Path

import pytest

from robocomp_dsl.deploy.network.router_plan import operator_endpoints
from robocomp_dsl.runtime.client import load_generated_interfaces
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from robocomp_dsl.runtime.presence.network_settings import domain_settings_path
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from tests.deploy.network.made_certificates import now, settings_with
from tests.deploy.network.network_node import NetworkNode, open_node
from tests.deploy.network.secured_deployment import SecuredDeployment
from tests.support.waiting import wait_until


def follow_losses(node: NetworkNode, role: str, interface: str) -> list[str]:
    """The names of the ports that are lost from now on."""
    lost: list[str] = []
    registry = node.ports.presence.registry
    for record in wait_until(lambda: registry.find(role, interface)):
        registry.on_lost(record, lambda name=record.name: lost.append(name))  # type: ignore[misc]
    return lost


@pytest.mark.parametrize("host", [0, 1], ids=["router of the client", "router of the server"])
def test_killed_router_looks_like_no_end_of_components(
    site: SecuredDeployment, components: Path, monkeypatch: pytest.MonkeyPatch, host: int
) -> None:
    interfaces = load_generated_interfaces(components / "boss")
    boss, worker = site.settings_file("boss"), site.settings_file("worker")
    with (
        site.routers() as routers,
        open_node(worker, "worker", site.domain, monkeypatch) as server,
        open_node(boss, "boss", site.domain, monkeypatch) as client,
    ):
        server.serve(interfaces.JOB, "Job", {"twice": lambda x: 2 * x})
        reliable = Qos(reliable=True)
        news = server.publisher(interfaces.NEWS, "News", reliable)
        state = server.publisher(interfaces.STATE, "State", Qos(latched=True))
        received = client.subscribe(interfaces.NEWS, "News", "worker.News", qos=reliable)
        latched = client.subscribe(interfaces.STATE, "State", "worker.State", qos=Qos(latched=True))
        operations = client.operations(interfaces.JOB, "worker.Job")
        assert wait_until(lambda: operations["twice"](4), ignoring=MiddlewareError) == 8
        lost = follow_losses(client, "server", "Tasks::Job")
        lost += follow_losses(client, "publisher", "Tasks::News")

        def hears(text: str) -> bool:
            news(text)
            return text in received

        def sees(text: str) -> bool:
            state(text)
            return text in latched

        wait_until(lambda: hears("first"), "the publication did not arrive")
        wait_until(lambda: sees("before"), lambda: f"latched: {latched}")
        routers[host].process.send_signal(signal.SIGKILL)
        routers[host].end()
        with pytest.raises(NoServer, match=r"router|no reply from worker\.Job"):
            operations["twice"](4)
        state("while the router was away")
        news("lost")
        routers[host] = site.start_router(site.hosts[host])
        assert wait_until(lambda: operations["twice"](5), ignoring=MiddlewareError) == 10
        wait_until(lambda: hears("second"))
        wait_until(lambda: latched[-1] == "while the router was away")
        assert lost == []
        assert "lost" not in received
        counts = client.statistics.of("News", "news")
        client.statistics.refresh()
        assert counts.drops >= 1
        server.ports.close()
        wait_until(lambda: lost)
        routers[host].process.kill()


def test_state_monitor_reports_component_that_ends_while_its_router_is_away(
    site: SecuredDeployment, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is lost as soon as the others had time to connect to the router again."""
    states: list[tuple[str, str]] = []
    operator = domain_settings_path(site.domain)
    worker, boss = site.settings_file("worker"), site.settings_file("boss")
    with (
        site.routers() as routers,
        open_node(operator, "monitor", site.domain, monkeypatch),
        open_node(boss, "boss", site.domain, monkeypatch) as stays,
        open_node(worker, "worker", site.domain, monkeypatch) as ends,
    ):
        monitor = StateMonitor(site.domain)
        monitor.start(lambda name, _pid, state: states.append((name, state)))
        for node in (stays, ends):
            node.ports.publish_state("compute")
        wait_until(lambda: len(states) == 2)
        routers[1].process.kill()
        routers[1].end()
        ends.ports.close()
        routers[1] = site.start_router(site.hosts[1])
        wait_until(lambda: ("worker", "") in states)
        monitor.close()
        routers[1].process.kill()
    assert ("boss", "") not in states


def test_component_goes_on_after_its_certificate_has_expired(
    site: SecuredDeployment, components: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What runs is not interrupted; what connects again is refused."""
    interface = load_generated_interfaces(components / "boss").JOB
    end = now() + timedelta(seconds=4)
    with site.start_router(site.hosts[0]) as router:
        endpoints = operator_endpoints(site.deployment)[:1]
        short = settings_with(site.keys, tmp_path, endpoints, "boss", end=end - now())
        path = tmp_path / "boss.json"
        path.write_text(short.to_json(tmp_path))
        operator = domain_settings_path(site.domain)
        with (
            open_node(operator, "worker", site.domain, monkeypatch) as server,
            open_node(path, "boss", site.domain, monkeypatch) as client,
        ):
            server.serve(interface, "Job", {"twice": lambda x: 2 * x})
            operations = client.operations(interface, "worker.Job")
            assert wait_until(lambda: operations["twice"](1), ignoring=MiddlewareError) == 2
            wait_until(lambda: now() > end + timedelta(seconds=1))
            assert operations["twice"](2) == 4
            router.process.send_signal(signal.SIGHUP)
            router.until("invalid peer certificate: certificate expired")
            with pytest.raises(MiddlewareError, match="the router of this host is away"):
                operations["twice"](3)

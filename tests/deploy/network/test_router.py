"""The router program: what it refuses to start with, how it reloads, what it tells systemd."""

from __future__ import annotations

import json
import signal
import socket
import sys
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.network.port_uses import AddedConnection
from robocomp_dsl.runtime.client import load_generated_interfaces
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.network_settings import InvalidNetwork, domain_settings_path
from robocomp_dsl.runtime.router.router import check_can_listen
from robocomp_dsl.runtime.router.router_settings import read_router_settings
from tests.deploy.network.network_node import open_node
from tests.deploy.network.secured_deployment import SecuredDeployment
from tests.deploy.rcdeploy_process import RunningProcess
from tests.support.waiting import wait_until


def changed_settings(site: SecuredDeployment, **changes: Any) -> Path:
    """The settings of the first router with some fields replaced."""
    path = site.router_file(site.hosts[0])
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))
    return path


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"listen": ["tcp/0.0.0.0:7450"]}, "without TLS there is no connection between hosts"),
        ({"listen": []}, "the router could not be reached"),
        ({"listen": "tls/127.0.0.1:7450"}, "must be a list of endpoints"),
        ({"connect": ["tcp/10.0.0.2:7450"]}, "without TLS"),
        ({"ca": ""}, '"ca" must be a text'),
        ({"key": "none.key"}, "none.key cannot be read"),
        ({"access": {}}, "a router without access control does not listen"),
        ({"access": {"enabled": False, "default_permission": "deny"}}, "does not listen"),
        ({"access": {"enabled": True, "default_permission": "allow"}}, "does not listen"),
        ({"more": 1}, "must be a JSON object with exactly"),
    ],
)
def test_router_settings_refuse_to_listen_without_keys_or_rules(
    site: SecuredDeployment, changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(InvalidNetwork, match=message):
        read_router_settings(changed_settings(site, **changes))


def test_router_settings_refuse_key_that_others_can_read(site: SecuredDeployment) -> None:
    site.keys.key("router.left").chmod(0o644)
    with pytest.raises(InvalidNetwork, match="a private key that other users can use"):
        read_router_settings(site.router_file(site.hosts[0]))


def test_router_program_ends_with_reason_if_port_is_taken(site: SecuredDeployment) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        path = changed_settings(site, listen=[f"tls/127.0.0.1:{port}"])
        command = (sys.executable, "-m", "robocomp_dsl.runtime.router", str(path))
        with RunningProcess(*command) as router:
            assert router.end() == 1
    assert router.has(f"the router cannot listen at 127.0.0.1 port {port}: another program uses")
    assert router.has("port N;")


def test_check_can_listen_names_address_of_another_host() -> None:
    with pytest.raises(MiddlewareError, match="this host does not have the address"):
        check_can_listen("tls/192.0.2.1:7450")
    with pytest.raises(MiddlewareError, match="no such host name"):
        check_can_listen("tls/no-such-host.invalid:7450")


def test_router_program_reports_ready_to_systemd(
    site: SecuredDeployment, monkeypatch: pytest.MonkeyPatch
) -> None:
    address = str(site.keys.path / "notify")
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as notify:
        notify.bind(address)
        monkeypatch.setenv("NOTIFY_SOCKET", address)
        with site.start_router(site.hosts[0]) as router:
            assert b"READY=1" in notify.recv(1000)
            router.process.send_signal(signal.SIGTERM)
            assert b"STOPPING=1" in notify.recv(1000)
            assert router.end() == 0
    assert router.has("stopped")


def test_router_reload_allows_rewired_connection(
    site: SecuredDeployment, components: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`rcdeploy connect` at run time: new rules, and the clients stay connected."""
    interface = load_generated_interfaces(components / "boss").JOB
    operator = domain_settings_path(site.domain)
    boss = site.settings_file("boss")
    with (
        site.start_router(site.hosts[0]) as router,
        open_node(operator, "spare", site.domain, monkeypatch) as spare,
        open_node(boss, "boss", site.domain, monkeypatch) as client,
    ):
        spare.serve(interface, "Job", {"twice": lambda x: 3 * x})
        operations = client.operations(interface, "spare.Job")
        with pytest.raises(MiddlewareError):
            operations["twice"](2)
        router.until("denied: boss calls spare.Job twice")
        registry = client.ports.presence.registry
        record = registry.find("server", interface.name)[0]
        lost: list[object] = []
        registry.on_lost(record, lambda: lost.append(record))
        site.write_settings(site.rules([AddedConnection("boss", "Job", "spare", "Job")]))
        router.process.send_signal(signal.SIGHUP)
        router.until("uses new settings")
        assert wait_until(lambda: operations["twice"](2), ignoring=MiddlewareError) == 6
        assert lost == []


def test_router_reload_keeps_former_settings_if_new_ones_are_invalid(
    site: SecuredDeployment, monkeypatch: pytest.MonkeyPatch
) -> None:
    with site.start_router(site.hosts[0]) as router:
        changed_settings(site, access={})
        router.process.send_signal(signal.SIGHUP)
        router.until("the router goes on with the former settings")
        settings = site.settings_file("boss")
        with open_node(settings, "boss", site.domain, monkeypatch):
            router.until("boss is connected")

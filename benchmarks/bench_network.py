"""A component through the router of its host with mutual TLS, against a direct link; and outages.

In turns, between two processes of one machine. The router has the access rules of these two
components and looks for denials in its log, as in a deployment. Then routers and a component are
killed: how long until others see that, and until calls work again.
"""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.bench_middleware import Client, in_turns, ratio
from benchmarks.pose_interface import MOVER, TRACK
from robocomp_dsl.deploy.network.access_rules import AccessRules, ComponentAccess, component_grants
from robocomp_dsl.deploy.network.identities import Identity
from robocomp_dsl.deploy.network.key_folder import KeyFolder
from robocomp_dsl.deploy.network.port_uses import PortAction, PortUse
from robocomp_dsl.deploy.network.update_keys import update_keys
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.network_settings import NETWORK_VARIABLE, NetworkSettings

CLIENT, PEER, ROUTER = "client-zenoh", "peer-zenoh", "router.bench"
OUTAGES = 5


def rules(domain: str) -> AccessRules:
    """What the two components of `bench_middleware` do."""
    uses = {
        CLIENT: (
            PortUse(PortAction.CALLS, MOVER.name, "Mover", PEER, "Mover"),
            PortUse(PortAction.PUBLISHES, TRACK.name, "There"),
            PortUse(PortAction.SUBSCRIBES, TRACK.name, "Back", PEER, "*"),
        ),
        PEER: (
            PortUse(PortAction.SERVES, MOVER.name, "Mover"),
            PortUse(PortAction.PUBLISHES, TRACK.name, "Back"),
            PortUse(PortAction.SUBSCRIBES, TRACK.name, "There", CLIENT, "*"),
        ),
    }
    components = (
        ComponentAccess(name, own, tuple(component_grants(domain, name, own)))
        for name, own in uses.items()
    )
    return AccessRules(domain, tuple(components), (ROUTER,))


class BenchNetwork:
    """Keys and settings below `folder`, and the process of a router."""

    def __init__(self, folder: Path, domain: str) -> None:
        self.keys = KeyFolder(folder / "keys")
        required = [Identity(name, "component") for name in (CLIENT, PEER)]
        required.append(Identity(ROUTER, "router", ("127.0.0.1", "localhost")))
        update_keys("bench", required, self.keys, datetime.now(UTC))
        with socket.create_server(("127.0.0.1", 0)) as free:
            endpoint = f"tls/127.0.0.1:{free.getsockname()[1]}"
        files = {"ca": "ca.pem", "certificate": f"{ROUTER}.pem", "key": f"{ROUTER}.key"}
        access = rules(domain).to_zenoh()
        data = {"name": ROUTER, "listen": [endpoint], "connect": [], **files, "access": access}
        self.router_file = self.keys.path / "router.json"
        self.router_file.write_text(json.dumps(data))
        for name in (CLIENT, PEER):
            settings = NetworkSettings(
                (endpoint,),
                self.keys.certificate("ca"),
                self.keys.certificate(name),
                self.keys.key(name),
            )
            self.settings(name).write_text(settings.to_json(self.keys.path))

    def settings(self, name: str) -> Path:
        """The file for `ROBOCOMP_NETWORK`."""
        return self.keys.path / f"{name}.json"

    def start_router(self) -> subprocess.Popen[str]:
        """Start the router; returns when it listens."""
        command = [sys.executable, "-m", "robocomp_dsl.runtime.router", str(self.router_file)]
        router = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        assert router.stderr
        while "listens at" not in router.stderr.readline():
            assert router.poll() is None
        return router


@contextmanager
def peer(domain: str, network: str) -> Iterator[subprocess.Popen[str]]:
    """The other process, with or without a network."""
    environment = {**os.environ, NETWORK_VARIABLE: network}
    command = [sys.executable, "-m", "benchmarks.middleware_peer", domain, "zenoh"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
    ) as process:
        assert process.stdout
        assert process.stdin
        process.stdout.readline()
        yield process
        process.stdin.close()


def client(domain: str, network: str) -> Client:
    """The client in this process."""
    os.environ[NETWORK_VARIABLE] = network
    try:
        return Client("zenoh", domain)
    finally:
        del os.environ[NETWORK_VARIABLE]


def round_trips(domain: str, network: BenchNetwork) -> list[dict[str, Any]]:
    """Query and publish round trips over both ways."""
    with peer(domain, ""), peer(f"{domain}-net", str(network.settings(PEER))):
        direct = client(domain, "")
        routed = client(f"{domain}-net", str(network.settings(CLIENT)))
        took = in_turns(
            {
                "direct query": direct.query,
                "direct publish": direct.publish,
                "routed query": routed.query,
                "routed publish": routed.publish,
            }
        )
        for each in (direct, routed):
            each.ports.close()
    figures = [
        {"name": f"{name} round trip", "value": median(values), "unit": "us"}
        for name, values in took.items()
    ]
    for kind in ("query", "publish"):
        value = ratio(took, f"routed {kind}", f"direct {kind}")
        name = f"{kind}: router with TLS and rules / direct link"
        figures.append({"name": name, "value": value, "unit": "x"})
    return figures


def outages(
    domain: str, network: BenchNetwork, router: subprocess.Popen[str]
) -> list[dict[str, Any]]:
    """Kill the router, then the peer."""
    settings = str(network.settings(PEER))
    calls_again, interrupted, lost = [], [], []
    with peer(domain, settings) as killed:
        routed = client(domain, str(network.settings(CLIENT)))
        for _ in range(OUTAGES):
            killed_at = time.monotonic()
            router.kill()
            router.wait()
            router = network.start_router()
            begun = time.monotonic()
            while True:
                try:
                    routed.query()
                except MiddlewareError:
                    continue
                break
            calls_again.append((time.monotonic() - begun) * 1e3)
            interrupted.append(time.monotonic() - killed_at)
        registry = routed.ports.presence.registry
        record = registry.find("server", MOVER.name)[0]
        registry.on_lost(record, lambda: lost.append(time.monotonic()))
        begun = time.monotonic()
        killed.send_signal(signal.SIGKILL)
        while not lost:
            time.sleep(0.0005)
        routed.ports.close()
    router.terminate()
    router.wait()
    return [
        {"name": "router back -> calls work again", "value": median(calls_again), "unit": "ms"},
        {"name": "the longest of them", "value": max(calls_again), "unit": "ms"},
        {
            "name": "kill -9 of the router, new process -> calls",
            "value": median(interrupted),
            "unit": "s",
        },
        {"name": "kill -9 -> seen by others", "value": (lost[0] - begun) * 1e3, "unit": "ms"},
    ]


def run() -> list[dict[str, Any]]:
    """All figures."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    with tempfile.TemporaryDirectory() as name:
        network = BenchNetwork(Path(name), f"{domain}-net")
        router = network.start_router()
        try:
            figures = round_trips(domain, network)
            return figures + outages(f"{domain}-net", network, router)
        finally:
            router.kill()
            router.wait()

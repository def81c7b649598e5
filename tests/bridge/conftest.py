"""A name server of YARP, programs with ports on it, and `rcgen` in the process of the test."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from tests.bridge.bridge_run import Peer
from tests.cli.rcgen_run import Rcgen

LOOPBACK = "127.0.0.1"


@pytest.fixture
def rcgen(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Rcgen:
    monkeypatch.setenv("NO_COLOR", "1")
    return Rcgen(monkeypatch, capsys)


@pytest.fixture
def domain() -> str:
    return f"bridge-{uuid.uuid4().hex[:10]}"


@pytest.fixture
def name_server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[NameServer]:
    """A name server that all components of the test find by their configuration of YARP."""
    server = NameServer((LOOPBACK, 0))
    home = tmp_path / "yarp-home"
    home.mkdir()
    (home / "yarp.conf").write_text(f"{LOOPBACK} {server.number} yarp\n")
    monkeypatch.setenv("YARP_CONFIG_HOME", str(home))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    yield server
    server.close()


@pytest.fixture
def peer(domain: str) -> Iterator[Callable[..., Peer]]:
    """Opens programs; they end with the test."""
    opened: list[Peer] = []

    def open_peer(middleware: str, *, shares_domain: bool = False, **addresses: str) -> Peer:
        name = f"peer{len(opened)}"
        own = domain if shares_domain else f"{domain}-{name}"
        opened.append(Peer(name, own, middleware, addresses=addresses))
        return opened[-1]

    yield open_peer
    for program in opened:
        program.close()

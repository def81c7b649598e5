"""Simulated hosts for tests: `make test-hosts`."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.hosts.rig.cgroups import remove_stale_cgroups
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.namespaces import TestNetwork
from tests.hosts.rig.requirements import missing_requirement

HERE = Path(__file__).parent


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Every test that uses simulated hosts has the marker `hosts`."""
    for item in items:
        names = getattr(item, "fixturenames", ())
        if item.path.is_relative_to(HERE) and {"hosts", "module_hosts", "test_network"} & set(
            names
        ):
            item.add_marker(pytest.mark.hosts)


@pytest.fixture(scope="session")
def test_network() -> Iterator[TestNetwork]:
    """The network of the hosts; until the end of the session this process is in it."""
    if reason := missing_requirement():
        pytest.skip(reason)
    remove_stale_cgroups()
    network = TestNetwork()
    yield network
    network.close()


@pytest.fixture
def hosts(test_network: TestNetwork, tmp_path: Path) -> Iterator[Hosts]:
    """Hosts that end with the test."""
    hosts = Hosts(tmp_path / "hosts", test_network)
    yield hosts
    hosts.close()


@pytest.fixture(scope="module")
def module_hosts(
    test_network: TestNetwork, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Hosts]:
    """Hosts that end with the module."""
    hosts = Hosts(tmp_path_factory.mktemp("hosts"), test_network)
    yield hosts
    hosts.close()


@pytest.fixture
def operator(module_hosts: Hosts, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The home of the person who runs rcdeploy in this process, without any file of before."""
    for path in (module_hosts.operator / ".config/robocomp", module_hosts.key.parent / "config"):
        shutil.rmtree(path, ignore_errors=True)
        path.unlink(missing_ok=True)
    monkeypatch.setenv("HOME", str(module_hosts.operator))
    monkeypatch.delenv("SSH_AUTH_SOCK", raising=False)
    for name in ("CONFIG", "STATE", "DATA", "CACHE"):
        monkeypatch.delenv(f"XDG_{name}_HOME", raising=False)
    return module_hosts.operator

"""Fixtures of the tests of the network: generated components, and folders for keys and sockets."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.network.secured_deployment import (
    BOSS,
    BOSS_CODE,
    PARAMETERS,
    TICKER,
    WORKER,
    WORKER_CODE,
    SecuredDeployment,
    generate,
)
from tests.deploy.rcdeploy_process import runtime_folder


@pytest.fixture(scope="module")
def components(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """`boss`, `worker` and `ticker`, generated."""
    folder = tmp_path_factory.mktemp("components")
    generate(folder, "boss", BOSS, BOSS_CODE)
    generate(folder, "worker", WORKER, WORKER_CODE, PARAMETERS)
    code = WORKER_CODE.replace("worker_generated", "ticker_generated")
    generate(folder, "ticker", TICKER, code)
    return folder


@pytest.fixture
def private_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Folders for keys, settings and sockets that belong to the test."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    with runtime_folder(monkeypatch):
        yield tmp_path


@pytest.fixture
def site(components: Path, private_home: Path) -> SecuredDeployment:
    """The deployment on two hosts; nothing runs yet."""
    return SecuredDeployment(components)

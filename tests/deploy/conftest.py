"""Fixtures of the tests of deployments."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.generated_components import generate_components
from tests.deploy.laser_app import APP, ARM, EYE
from tests.deploy.rcdeploy_process import runtime_folder


@pytest.fixture
def socket_folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where the processes of the test find each other."""
    with runtime_folder(monkeypatch) as path:
        monkeypatch.setenv("XDG_STATE_HOME", str(path.parent / "state"))
        yield path


@pytest.fixture
def app_folder(tmp_path: Path, socket_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two generated components and their deployment."""
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path, {"arm": ARM, "eye": EYE})
    (tmp_path / "app.ddsl").write_text(APP)
    return tmp_path

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from tests.middleware.network import DEADLINE


def set_discovery_timeout(seconds: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Set how long calls wait for a server that has not been discovered yet."""
    module = "robocomp_dsl.runtime.connection.peer_selection"
    monkeypatch.setattr(f"{module}.DISCOVERY_TIMEOUT_S", seconds)


@pytest.fixture(autouse=True)
def long_discovery_timeout(monkeypatch: pytest.MonkeyPatch) -> None:
    """Calls wait for servers longer than any test does, however busy the machine is."""
    set_discovery_timeout(3 * DEADLINE, monkeypatch)


@pytest.fixture
def short_discovery_timeout(long_discovery_timeout: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Calls wait shortly: the test has no server, or knows that all are discovered."""
    set_discovery_timeout(0.1, monkeypatch)

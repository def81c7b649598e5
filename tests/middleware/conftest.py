from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from tests.middleware.network import DEADLINE, Network

MIDDLEWARES = ("inproc", "zenoh")


def grace_is(seconds: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """So long do calls wait for a server that has not been there yet."""
    for module in ("inproc", "zenoh.client"):
        monkeypatch.setattr(
            f"robocomp_dsl.runtime.middleware.{module}.DISCOVERY_TIMEOUT_S", seconds
        )


@pytest.fixture(autouse=True)
def grace(monkeypatch: pytest.MonkeyPatch) -> None:
    """Who is to come is waited for, however busy the machine is; longer than any test waits."""
    grace_is(3 * DEADLINE, monkeypatch)


@pytest.fixture
def hasty(grace: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """For those who wait for nobody, or know that all are there."""
    grace_is(0.1, monkeypatch)


@pytest.fixture(params=MIDDLEWARES)
def network(request: pytest.FixtureRequest) -> Iterator[Network]:
    opened = Network(request.param)
    yield opened
    opened.close()

"""Fixtures of the tests of monitors."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.monitors.components import Deployment


@pytest.fixture(params=["inproc", "zenoh"])
def deployment(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Deployment]:
    """A deployment on every middleware."""
    opened = Deployment(tmp_path, request.param)
    yield opened
    opened.close()


@pytest.fixture
def quick_deployment(tmp_path: Path) -> Iterator[Deployment]:
    """A deployment in this process: for what does not depend on the middleware."""
    opened = Deployment(tmp_path, "inproc")
    yield opened
    opened.close()

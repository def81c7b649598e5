"""Fixtures of the tests of state machines."""

from __future__ import annotations

import pytest

from tests.machine.machine_samples import ManualClock, Worker


@pytest.fixture
def clock() -> ManualClock:
    return ManualClock()


@pytest.fixture
def worker() -> Worker:
    return Worker()

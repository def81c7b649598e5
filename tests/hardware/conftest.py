"""The arms that tests of control take, one after the other."""

from __future__ import annotations

import pytest

from tests.support.simulated_arm import ARMS, Arm


@pytest.fixture(params=ARMS)
def arm(request) -> Arm:
    return Arm(request.param)

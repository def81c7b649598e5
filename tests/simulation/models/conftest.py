"""Fixtures of the tests of models."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.simulation.robots.catalog import ROBOTS
from tests.simulation.model_worlds import ARM
from tests.simulation.models.simulated_robot import SimulatedRobot
from tests.simulation.served_worlds import Served, served_model


@pytest.fixture
def arm(tmp_path: Path) -> Served:
    return served_model(tmp_path, ARM)


@pytest.fixture(scope="module", params=list(ROBOTS))
def simulated(request) -> SimulatedRobot:
    return SimulatedRobot(request.param)

"""Fixtures of the tests of touch."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from tests.touch.kinematic_robot import ARMS, ROBOTS, CentredRobot, ReflexHarness


@pytest.fixture
def start_reflex() -> Iterator[Callable[..., ReflexHarness]]:
    """Starts a reflex and its robot with the arguments of `ReflexHarness`; closes them."""
    systems: list[ReflexHarness] = []

    def start(*arguments: object, **params: object) -> ReflexHarness:
        systems.append(ReflexHarness(*arguments, **params))
        return systems[-1]

    yield start
    for system in systems:
        system.close()


@pytest.fixture(params=ROBOTS)
def harness(start_reflex, request) -> ReflexHarness:
    """The reflex of a robot, which watches; its arm is in the start pose."""
    return start_reflex(request.param).wait_until_watching()


@pytest.fixture(params=ARMS, ids=[f"{robot}-{side}" for robot, side in ARMS])
def centred_harness(start_reflex, request) -> ReflexHarness:
    """The reflex of one arm with the law `fixed`; its arm is far from all limits."""
    return start_reflex(*request.param, CentredRobot, law="fixed").wait_until_watching()

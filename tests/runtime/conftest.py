"""Fixtures of the tests of the runtime."""

from __future__ import annotations

import uuid
from collections.abc import Iterator

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from tests.runtime.arm_component import Arm, ArmParams


@pytest.fixture
def arm_runner() -> Iterator[Runner]:
    domain = f"test-{uuid.uuid4().hex[:8]}"
    component = Runner(Arm, ArmParams.load(), RunSettings(domain=domain, middleware="inproc"))
    component.start()
    yield component
    component.stop()
    component.wait()


@pytest.fixture
def arm_proxy(arm_runner: Runner) -> Iterator[ComponentProxy]:
    host = ComponentContext("tester", arm_runner.settings.domain, CallbackGroup(), Statistics())
    middleware = open_ports("inproc", host)
    yield ComponentProxy(middleware.proxy(Endpoint(COMPONENT, "tester", "Component", ("arm",))))
    middleware.close()

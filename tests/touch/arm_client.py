"""The generic arm as a component under test, and its caller, in one process."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import shipped_component
from served_robot import ServedRobot

from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host
from robocomp_dsl.runtime.runner import Runner
from robocomp_dsl.runtime.settings import RunSettings
from robocomp_dsl.runtime.statistics import Statistics

ARM = shipped_component.load("generic_arm")
DESCRIPTIONS = Path(__file__).parents[2] / "robocomp_dsl" / "hardware" / "robots" / "descriptions"
FIRST_BOARD = {"nao_h25": "LArm", "nao_h21": "LArm", "icub_v2": "left_arm"}


def until(what: Callable[[], Any], seconds: float = 30.0) -> None:
    """Wait for `what` to become true."""
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it did not come true in time"
        time.sleep(0.002)


class RunningArm:
    """A `generic_arm` in front of a robot of the same domain. `states` are what it published."""

    def __init__(self, domain: str, wires: dict[str, str], *settings: str) -> None:
        params = ARM.worker.SPEC.parameters.load(None, settings)
        self.runner = Runner(
            ARM.worker,
            params,
            RunSettings(
                domain=domain,
                middleware="inproc",
                wires={port: (peer,) for port, peer in wires.items()},
            ),
        )
        self.runner.start()
        self._client = open_middleware("inproc", Host("client", domain, Execution(), Statistics()))
        self.states: list[Any] = []
        topic = ARM.interfaces.GenericArmStateProxy.INTERFACE
        self._client.subscribe(
            Endpoint(topic, "client", "GenericArmState"),
            {"armState": self.states.append},
            Execution(),
        )
        proxy = ARM.interfaces.GENERICARM
        link = self._client.proxy(Endpoint(proxy, "client", "arm"))
        assert link.wait(10)
        self._bound = {one.name: link.bind(one) for one in proxy.operations}

    def __getattr__(self, operation: str) -> Any:
        return self._bound[operation]

    def end(self) -> bool:
        self.runner.stop()
        well = self.runner.wait()
        self._client.close()
        return well

    def came_to_rest(self) -> None:
        until(lambda: not self.getState().moving)


def wires_of(robot: ServedRobot, name: str) -> dict[str, str]:
    return {"board": f"robot.{FIRST_BOARD[name]}"}

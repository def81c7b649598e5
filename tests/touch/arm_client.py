"""The generic arm as a component under test, and its caller, in one process."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from tests.support.waiting import wait_until
from tests.touch import shipped_component
from tests.touch.served_robot import ServedRobot

ARM = shipped_component.load("generic_arm")
DESCRIPTIONS = Path(__file__).parents[2] / "robocomp_dsl" / "simulation" / "robots" / "descriptions"
FIRST_BOARD = {"nao_h25": "LArm", "nao_h21": "LArm", "icub_v2": "left_arm"}
GOAL = np.array([0.5, 0.6, 0.3, 0.9, 0.2])
"""Generic angles that both robots reach [rad]."""
NONE = np.zeros(0)
"""No speeds: those of the description."""
_domains = (f"generic-arm-{number}" for number in count())


def refusal_of(call: Callable[..., Any], *arguments: Any) -> str:
    """The message with which the arm refuses the call."""
    try:
        call(*arguments)
    except ARM.interfaces.NotPossible as error:
        return str(error.what)
    raise AssertionError(f"{arguments} were accepted")


class RunningArm:
    """A `generic_arm` of the domain; its operations are methods. `states` are what it published."""

    def __init__(
        self, domain: str, wires: dict[str, str], *settings: str, clock: Clock | None = None
    ) -> None:
        params = ARM.worker.SPEC.parameters.load(None, ("period=2", *settings))
        wired = {port: (peer,) for port, peer in wires.items()}
        run_settings = RunSettings(domain=domain, middleware="inproc", connections=wired)
        self.runner = Runner(ARM.worker, params, run_settings, clock)
        self._client = open_ports(
            "inproc", ComponentContext("client", domain, CallbackGroup(), Statistics())
        )
        self.states: list[Any] = []
        topic = ARM.interfaces.GenericArmStateProxy.INTERFACE
        at = Endpoint(topic, "client", "GenericArmState")
        self._client.subscribe(at, {"armState": self.states.append}, CallbackGroup())
        self.runner.start()
        interface = ARM.interfaces.GENERICARM
        link = self._client.proxy(Endpoint(interface, "client", "arm"))
        assert link.wait(60)
        self._bound = {operation.name: link.bind(operation) for operation in interface.operations}

    def __getattr__(self, operation: str) -> Any:
        return self._bound[operation]

    def end(self) -> bool:
        """Stop the component. Returns whether it ended in order."""
        self.runner.stop()
        well = self.runner.wait()
        self._client.close()
        return well

    def start_motion(self, command: Callable[..., Any], *arguments: Any) -> None:
        """Give the command, and see that it moves; it may be at rest again before anybody looks."""
        seen = len(self.states)
        command(*arguments)
        wait_until(lambda: any(state.moving for state in self.states[seen:]))

    def wait_for_rest(self) -> Any:
        """The state once nothing moves any more."""
        wait_until(lambda: not self.getState().moving)
        return self.getState()


@contextmanager
def arm_on(
    robot: str,
    *settings: str,
    description: Path | None = None,
    pose: Mapping[str, float] | None = None,
    clock: Clock | None = None,
    **wires: str,
) -> Iterator[tuple[RunningArm, ServedRobot]]:
    """A robot and its left arm, that has been reached. `wires` are boards of the robot by port.

    The robot stands in the start pose of its description but for the joints of `pose`.
    """
    domain = next(_domains)
    served = ServedRobot(robot, ARM.interfaces, domain, pose or {})
    wired = {port: f"robot.{board}" for port, board in wires.items()}
    arm = RunningArm(
        domain,
        wired or {"board": f"robot.{FIRST_BOARD[robot]}"},
        f"description={description or DESCRIPTIONS / f'{robot}.yaml'}",
        *settings,
        clock=clock,
    )
    try:
        wait_until(lambda: arm.states or arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        yield arm, served
    finally:
        well = arm.end()
        served.disconnect()
    assert well

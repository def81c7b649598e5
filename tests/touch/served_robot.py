"""A simulated robot whose control boards are served in the test's own process.

Time passes when a board is asked for its state: the test is as fast as the machine, and no result
depends on the clock.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.servants.joints.control_board import ControlBoardServant
from robocomp_dsl.hardware.servants.serving import DevicePort
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.robots.boards import board_names, robot_board, whole_robot
from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.world.world import World

TICK = 0.01
"""So much time passes with every question for a state [s]."""


class ServedRobot:
    """The robot `name`; every board is a port of the component `robot`, named as the board.

    `calls` are the called operations of boards; `before` is called in front of an operation,
    `after` with its result; `failing` are the exceptions that operations raise.
    """

    def __init__(
        self, name: str, interfaces: ModuleType, domain: str, pose: Mapping[str, float]
    ) -> None:
        self.robot = ROBOTS[name]()
        self.part = SimulatedBoard(whole_robot(self.robot))
        self.joints = {b: robot_board(self.robot, b).spec.names for b in board_names(self.robot)}
        self.part.groups = {j: b for b, joints in self.joints.items() for j in joints}
        spec = new_world()
        add_robot(spec, self.robot)
        self.world = World(spec, [self.part])
        set_pose(self.world.model, self.world.data, self.robot, **pose)
        self.world.advance(0.001)
        self.part.commands.set_mode(None, Mode.POSITION)
        self.ticking = True
        self.calls: list[tuple[str, str]] = []
        self.before: dict[tuple[str, str], Callable[[], None]] = {}
        self.after: dict[tuple[str, str], Callable[[Any], Any]] = {}
        self.failing: dict[tuple[str, str], Exception] = {}
        self._interfaces, self._domain = interfaces, domain
        self._turn = threading.RLock()
        self.connect()

    def connect(self) -> None:
        """Serve the boards."""
        self._execution = CallbackGroup()
        self._middleware = open_ports(
            "inproc", ComponentContext("robot", self._domain, self._execution, Statistics())
        )
        interface = self._interfaces.CONTROLBOARD
        for name, joints in self.joints.items():
            devices = dict.fromkeys(joints, self.part)
            servant = ControlBoardServant(interface, name, joints, devices)
            handlers = {
                operation.name: self._watched(
                    name, operation.name, getattr(DevicePort(servant, self._turn), operation.name)
                )
                for operation in interface.operations
            }
            at = Endpoint(interface, "robot", name)
            self._middleware.serve(at, handlers, self._execution)

    def _watched(self, board: str, operation: str, call: Any) -> Any:
        def answer(*arguments: Any) -> Any:
            if operation == "getState" and self.ticking:
                with self._turn:
                    self.world.advance(TICK)
            self.before.get((board, operation), int)()
            self.calls.append((board, operation))
            if (board, operation) in self.failing:
                raise self.failing[board, operation]
            result = call(*arguments)
            self.after.get((board, operation), lambda _: None)(result)
            return result

        return answer

    def disconnect(self) -> None:
        """Stop serving the boards."""
        self._middleware.close()

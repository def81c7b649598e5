"""Observes and touches a robot under its reflex, as a client of its domain.

In: the domain of a deployment of `robot`, `arm` and `reflex`. Out: a `Stage` to press on, and the
published data. All waiting is in simulated time; a wait fails if that stops.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from failure import DemoFailed
from recording import Floats, Place
from topic_buffer import TopicBuffer, skin_of

from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces
from robocomp_dsl.runtime.component.component_interface import LifeState
from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from robocomp_dsl.simulation.simulation_interface import SIMULATION, SimulationProxy

COMPONENTS = Path(__file__).parents[1]
ROBOT, ARM, REFLEX = "robot", "arm", "reflex"
FINGER = "finger"
FINGER_JOINTS = ["finger_x", "finger_y", "finger_z"]
STIFF = {"kp": 2000.0, "ki": 0.0, "kd": 40.0, "maxOutput": 20.0, "maxIntegral": 0.0}
"""N/m, N s/m and N: an impedance of the finger that yields 1 mm under 2 N."""
WAIT_TIMEOUT_S = 90.0
"""Wall-time limit of the start, and of every later wait."""
_FINGER_PERIOD_S = 0.02
_EXIT_DETECTION_S = 1.0
"""Time within which the exit of a component is detected."""
_REST_WINDOW_S, _REST_MOTION = 0.15, 0.004
"""The arm is at rest if it moved by at capacity so many rad within so many s."""


class RobotUnderTest:
    """The robot, from the start of its components to `close`.

    `alive` raises when the deployment has exited. With `capacity`, only so much data is stored, and
    simulated time may pause and be reset. Raises `DemoFailed` if the components do not start, and
    later if one has exited.
    """

    def __init__(
        self, domain: str, part: str, alive: Callable[[], None], capacity: int | None
    ) -> None:
        self._alive, self._exited, self._timeout_s = alive, "", WAIT_TIMEOUT_S
        self._links, self._watch = DomainClient(domain), StateMonitor(domain)
        try:
            self._find(part, capacity)
        except BaseException:
            self.close()
            raise

    def _find(self, part: str, capacity: int | None) -> None:
        touch, board = (
            load_generated_interfaces(COMPONENTS / "reflex"),
            load_generated_interfaces(COMPONENTS / "generic_arm"),
        )
        self._waiting = threading.Condition()
        self._until(self._all_run, "that all components run")
        self._watch.start(self._on_state)
        self._reflex = self._links.operations(touch.REFLEX, REFLEX, "Reflex")
        self._calm = touch.ReflexState.Watching
        self._boards = {
            port: self._links.operations(board.CONTROLBOARD, ROBOT, port)
            for port in self._board_ports()
        }
        if FINGER not in self._boards:
            raise DemoFailed(f"`{ROBOT}` serves no control board `{FINGER}`")
        self._finger = self._boards[FINGER]
        self.skin = skin_of(self._links.operations(touch.SKIN, ROBOT, "Skin").getGeometry())
        self.buffer = TopicBuffer(self.skin, part, capacity)
        self._waiting = self.buffer.changed
        for interface, component, port, handlers in (
            (touch.SKINFRAME, ROBOT, "SkinFrame", {"frame": self.buffer.frame}),
            (touch.GENERICARMSTATE, ARM, "GenericArmState", {"armState": self.buffer.arm_state}),
            (touch.REFLEXEVENTS, REFLEX, "ReflexEvents",
             {"reflex": self.buffer.answer, "stateChanged": self.buffer.reflex_state}),
        ):  # fmt: skip
            self._links.subscribe(interface, component, port, handlers)
        self._until(lambda: self.buffer.complete, "frames of the skin and states of the arm")
        for joint in FINGER_JOINTS:
            self._call(self._finger.setPid, board.Loop.PositionLoop, joint, board.Pid(**STIFF))
        self._read_finger()
        self._timeout_s = WAIT_TIMEOUT_S if capacity is None else float("inf")

    # Properties.

    def places(self) -> tuple[Place, ...]:
        """The receptive fields of the reflex."""
        return tuple(
            Place(field.name, field.limb, np.array([field.x, field.y, field.z]), field.radius)
            for field in self._call(self._reflex.getFields)
        )

    def joints(self) -> Mapping[str, float]:
        """Positions of all joints of the robot and the finger, by name."""
        found: dict[str, float] = {}
        for board in self._boards.values():
            names = [joint.name for joint in self._call(board.getJoints)]
            found |= zip(names, self._call(board.getState).position.tolist(), strict=True)
        return found

    def simulation(self) -> SimulationProxy:
        """The complete world of the robot."""
        return SimulationProxy(self._links.channel(SIMULATION, ROBOT, "Simulation"))

    # Implementation of `Stage`.

    def now(self) -> float:
        """Simulated time in s."""
        return self.buffer.now

    def arm(self) -> Floats:
        """Generic angles of the arm, (5,)."""
        return self.buffer.angles

    def finger(self) -> Floats:
        """The finger's joint positions, (3,)."""
        self._read_finger()
        return self.buffer.finger

    def move_finger(self, joints: Floats, seconds: float) -> None:
        """Move the finger so that it arrives after some seconds; returns immediately."""
        speed = np.maximum(np.abs(joints - self.finger()) / seconds, 1e-4)
        self._call(self._finger.setReferenceSpeed, FINGER_JOINTS, speed)
        self._call(self._finger.positionMove, FINGER_JOINTS, joints)

    def free_since(self) -> float:
        """Time since which the arm's skin has felt nothing; infinite while it feels something."""
        return self.buffer.free_since

    def wait_until_calm(self) -> None:
        """Wait until the reflex is watching and the arm is at rest."""

        def calm() -> bool:
            if not self.buffer.is_at_rest(_REST_WINDOW_S, _REST_MOTION):
                return False
            return bool(self._call(self._reflex.getStatistics).state == self._calm)

        self._until(calm, "that the reflex watches and the arm is at rest")

    def wait(self, seconds: float) -> None:
        """Wait for simulated time, and record the finger meanwhile."""
        since = self.now()

        def over() -> bool:
            now = self.now()
            if now >= self.buffer.finger_seen + _FINGER_PERIOD_S:
                self._read_finger()
            return not since <= now < since + seconds  # simulated time may be reset

        self._until(over, f"{seconds:.2f} s of simulated time")

    # Internals.

    def _all_run(self) -> bool:
        running = (self._links.component(name).getInfo().state for name in (ROBOT, ARM, REFLEX))
        try:
            return all(state == LifeState.Compute for state in running)
        except MiddlewareError:
            return False  # not available yet

    def _board_ports(self) -> list[str]:
        ports = self._links.component(ROBOT).getInfo().ports
        return [
            port.name
            for port in ports
            if port.role == "implements" and port.declared.endswith("::ControlBoard")
        ]

    def _read_finger(self) -> None:
        state = self._call(self._finger.getState)
        self.buffer.finger_at(float(state.time), np.array(state.position, dtype=np.float64))

    def _call(self, call: Callable[..., Any], *inputs: Any) -> Any:
        """The reply of a component. Raises `DemoFailed` if there is none."""
        try:
            return call(*inputs)
        except DeclaredError as refused:
            raise DemoFailed(f"a component refuses: {refused}") from None
        except MiddlewareError as error:
            self._check_for_exit()
            raise DemoFailed(f"a component does not answer: {error}") from None

    def _check_for_exit(self) -> None:
        """Handle a missing reply: its component may have just exited."""
        deadline = time.monotonic() + _EXIT_DETECTION_S
        while time.monotonic() < deadline:
            self._check()
            time.sleep(_FINGER_PERIOD_S)

    def _until(self, done: Callable[[], bool], what: str) -> None:
        deadline = time.monotonic() + self._timeout_s
        while not done():
            self._check()
            if time.monotonic() > deadline:
                raise DemoFailed(f"waited {self._timeout_s:.0f} s for {what}")
            with self._waiting:
                self._waiting.wait(_FINGER_PERIOD_S)

    def _check(self) -> None:
        self._alive()
        if self._exited:
            raise DemoFailed(f"`{self._exited}` ended in the middle of the demo")

    def _on_state(self, name: str, _pid: int, state: str) -> None:
        if not state and name in {ROBOT, ARM, REFLEX}:
            self._exited = self._exited or name

    def close(self) -> None:
        """Leave the domain."""
        self._watch.close()
        self._links.close()

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
from robocomp_dsl.runtime.middleware.zenoh.liveliness_monitor import LivelinessMonitor
from robocomp_dsl.simulation.simulation_interface import SIMULATION, SimulationProxy

COMPONENTS = Path(__file__).parents[1]
ROBOT, ARM, REFLEX = "robot", "arm", "reflex"
FINGER = "finger"
FINGER_JOINTS = ["finger_x", "finger_y", "finger_z"]
STIFF = {"kp": 2000.0, "ki": 0.0, "kd": 40.0, "maxOutput": 20.0, "maxIntegral": 0.0}
"""N/m, N s/m and N: an impedance of the finger that yields 1 mm under 2 N."""
PATIENCE_S = 90.0
"""Wall-time limit of the start, and of every later wait."""
_LOOKS_S = 0.02
_NEWS_S = 1.0
"""Time within which the exit of a component is detected."""
_CALM_S, _STILL = 0.15, 0.004
"""The arm is at rest if it moved by at most so many rad within so many s."""


class RobotUnderTest:
    """The robot, from the start of its components to `close`.

    `alive` raises when the deployment has exited. With `most`, only so much data is stored, and
    simulated time may pause and be reset. Raises `DemoFailed` if the components do not start, and
    later if one has exited.
    """

    def __init__(self, domain: str, part: str, alive: Callable[[], None], most: int | None) -> None:
        self._alive, self._lost, self._patience = alive, "", PATIENCE_S
        self._links, self._watch = DomainClient(domain), LivelinessMonitor(domain)
        try:
            self._find(part, most)
        except BaseException:
            self.close()
            raise

    def _find(self, part: str, most: int | None) -> None:
        touch, board = (
            load_generated_interfaces(COMPONENTS / "reflex"),
            load_generated_interfaces(COMPONENTS / "generic_arm"),
        )
        self._waiting = threading.Condition()
        self._until(self._all_run, "that all components run")
        self._watch.start(self._seen)
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
        self.heard = TopicBuffer(self.skin, part, most)
        self._waiting = self.heard.news
        for interface, component, port, handlers in (
            (touch.SKINFRAME, ROBOT, "SkinFrame", {"frame": self.heard.frame}),
            (touch.GENERICARMSTATE, ARM, "GenericArmState", {"armState": self.heard.arm_state}),
            (touch.REFLEXEVENTS, REFLEX, "ReflexEvents",
             {"reflex": self.heard.answer, "stateChanged": self.heard.reflex_state}),
        ):  # fmt: skip
            self._links.subscribe(interface, component, port, handlers)
        self._until(lambda: self.heard.complete, "frames of the skin and states of the arm")
        for joint in FINGER_JOINTS:
            self._asked(self._finger.setPid, board.Loop.PositionLoop, joint, board.Pid(**STIFF))
        self._look_at_finger()
        self._patience = PATIENCE_S if most is None else float("inf")

    # Properties.

    def places(self) -> tuple[Place, ...]:
        """The receptive fields of the reflex."""
        return tuple(
            Place(field.name, field.limb, np.array([field.x, field.y, field.z]), field.radius)
            for field in self._asked(self._reflex.getFields)
        )

    def joints(self) -> Mapping[str, float]:
        """Positions of all joints of the robot and the finger, by name."""
        found: dict[str, float] = {}
        for board in self._boards.values():
            names = [joint.name for joint in self._asked(board.getJoints)]
            found |= zip(names, self._asked(board.getState).position.tolist(), strict=True)
        return found

    def simulation(self) -> SimulationProxy:
        """The complete world of the robot."""
        return SimulationProxy(self._links.channel(SIMULATION, ROBOT, "Simulation"))

    # Implementation of `Stage`.

    def now(self) -> float:
        """Simulated time in s."""
        return self.heard.now

    def arm(self) -> Floats:
        """Generic angles of the arm, (5,)."""
        return self.heard.angles

    def finger(self) -> Floats:
        """The finger's joint positions, (3,)."""
        self._look_at_finger()
        return self.heard.finger

    def move_finger(self, joints: Floats, seconds: float) -> None:
        """Move the finger so that it arrives after some seconds; returns immediately."""
        speed = np.maximum(np.abs(joints - self.finger()) / seconds, 1e-4)
        self._asked(self._finger.setReferenceSpeed, FINGER_JOINTS, speed)
        self._asked(self._finger.positionMove, FINGER_JOINTS, joints)

    def free_since(self) -> float:
        """Time since which the arm's skin has felt nothing; infinite while it feels something."""
        return self.heard.free_since

    def wait_until_calm(self) -> None:
        """Wait until the reflex is watching and the arm is at rest."""

        def calm() -> bool:
            if not self.heard.stands(_CALM_S, _STILL):
                return False
            return bool(self._asked(self._reflex.getStatistics).state == self._calm)

        self._until(calm, "that the reflex watches and the arm stands still")

    def wait(self, seconds: float) -> None:
        """Wait for simulated time, and record the finger meanwhile."""
        since = self.now()

        def over() -> bool:
            now = self.now()
            if now >= self.heard.finger_seen + _LOOKS_S:
                self._look_at_finger()
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

    def _look_at_finger(self) -> None:
        state = self._asked(self._finger.getState)
        self.heard.finger_at(float(state.time), np.array(state.position, dtype=np.float64))

    def _asked(self, call: Callable[..., Any], *inputs: Any) -> Any:
        """The reply of a component. Raises `DemoFailed` if there is none."""
        try:
            return call(*inputs)
        except DeclaredError as refused:
            raise DemoFailed(f"a component refuses: {refused}") from None
        except MiddlewareError as error:
            self._blame()
            raise DemoFailed(f"a component does not answer: {error}") from None

    def _blame(self) -> None:
        """Handle a missing reply: its component may have just exited."""
        deadline = time.monotonic() + _NEWS_S
        while time.monotonic() < deadline:
            self._check()
            time.sleep(_LOOKS_S)

    def _until(self, done: Callable[[], bool], what: str) -> None:
        deadline = time.monotonic() + self._patience
        while not done():
            self._check()
            if time.monotonic() > deadline:
                raise DemoFailed(f"waited {self._patience:.0f} s in vain for {what}")
            with self._waiting:
                self._waiting.wait(_LOOKS_S)

    def _check(self) -> None:
        self._alive()
        if self._lost:
            raise DemoFailed(f"`{self._lost}` ended in the middle of the demo")

    def _seen(self, name: str, _pid: int, state: str) -> None:
        if not state and name in {ROBOT, ARM, REFLEX}:
            self._lost = self._lost or name

    def close(self) -> None:
        """Leave the domain."""
        self._watch.close()
        self._links.close()

"""The shipped simulator of a robot, generic_arm and reflex, as they are, in one process.

They live in lock-step, so that a test sees the same each time and as fast as it can be. The fingers
are the simulator's own: one is put before a place and then moved by its control board.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.read import load_robot
from robocomp_dsl.tactile.description.yaml_reader import UNITS
from robocomp_dsl.tactile.reflex.law import Field
from tests.support.waiting import wait_until
from tests.touch import finger_geometry, shipped_component
from tests.touch.kinematic_robot import REFLEX, interfaces, proxy_of
from tests.touch.lockstep_harness import (
    ComponentSetup,
    LockstepHarness,
    SteppedClockSource,
)

BOARDS = {
    ("nao", "left_arm"): "LArm",
    ("nao", "right_arm"): "RArm",
    ("icub", "left_arm"): "left_arm",
    ("icub", "right_arm"): "right_arm",
}
ARM = shipped_component.load("generic_arm")
FINGER = finger_geometry.FINGERS[0]


def stepped_simulator(worker: Any) -> Any:
    """The simulator, but its time goes on only when the test says so."""

    class SteppedSimulator(SteppedClockSource, worker):  # type: ignore[misc]
        def initialize(self) -> None:
            worker.initialize(self)
            self.recorded: list[tuple[Floats, Floats]] = []
            self.frames: dict[float, Floats] = {}
            self.simulation.skin.subscribe(self.keep)

        def keep(self, frame: Any) -> None:
            self.frames[frame.time] = frame.force

        def tick(self) -> None:
            worker.compute(self)
            data = self.simulation.world.data
            self.recorded.append((data.qpos.copy(), data.qvel.copy()))

    return SteppedSimulator


class ShippedSystem(LockstepHarness):
    """`params` are parameters of the reflex. The arm has gone to its start pose."""

    def __init__(self, robot: str, side: str, **params: object) -> None:
        self.name, self.side = f"{robot}_simulator", side
        simulator = shipped_component.load(self.name)
        description = Path(simulator.folder) / "tactile.yaml"
        self.part = load_robot(description).part(side)
        both = (f"description={description}", f"part={side}")
        wires = {"board": (f"{self.name}.{BOARDS[robot, side]}",)}
        super().__init__(
            ComponentSetup(stepped_simulator(simulator.worker), ("speed=0",)),
            ComponentSetup(ARM.worker, (*both, "begin=start"), RunSettings(connections=wires)),
            ComponentSetup(REFLEX.worker, (*both, *(f"{k}={v}" for k, v in params.items()))),
        )
        self.reflex = self.proxy(proxy_of(interfaces.REFLEX), "reflex", "Reflex")
        board = proxy_of(ARM.interfaces.CONTROLBOARD)
        self.fingers = {
            finger: self.proxy(board, self.name, finger) for finger in finger_geometry.FINGERS
        }
        self._events: list[Any] = []
        at = Endpoint(interfaces.REFLEXEVENTS, "test_client", "ReflexEvents")
        self._middleware.subscribe(at, {"reflex": self._events.append}, CallbackGroup())
        self.arm = self.proxy(proxy_of(interfaces.GENERICARM), "generic_arm", "GenericArm")
        simulation = self.world.simulation
        self.model, self.data = simulation.world.model, simulation.world.data
        self._start = self.data.qpos.copy()

    @property
    def state(self) -> str:
        (state,) = self.worker(1).machine.states
        return str(state)

    def params(self, **params: float) -> None:
        """Other parameters of the reflex."""
        self.worker(1).params.set(params)

    def field(self, name: str) -> Field:
        return next(field for field in self.part.fields if field.name == name)

    def run_until(self, state: str, seconds: float = 10.0) -> None:
        end = self.world.clock.now() + seconds
        while self.state != state:
            assert self.world.clock.now() < end, f"still {self.state}: {self.worker(1).reason}"
            self.run(0.02)

    def joints(self) -> tuple[Floats, Floats]:
        """Angles and speeds (t, m) that the arm's own joints have had so far, as shares.

        0 and 1 are the limits of an angle; 1 is the largest speed.
        """
        servos = [servo for servo in self.part.servos if servo.joint]
        joints = [self.model.joint(servo.joint) for servo in servos]
        angles = np.array([q[[j.qposadr[0] for j in joints]] for q, _ in self.world.recorded])
        speeds = np.array([v[[j.dofadr[0] for j in joints]] for _, v in self.world.recorded])
        unit = np.array([UNITS[servo.unit] for servo in servos])
        low, high = (unit * [getattr(s, end) for s in servos] for end in ("low", "high"))
        return (angles - low) / (high - low), np.abs(speeds) / (unit * [s.speed for s in servos])

    def events(self) -> list[Any]:
        """What fields have answered so far; a subscriber receives them a moment later."""
        count = self.runners[1].statistics.of("ReflexEvents", "reflex")
        wait_until(lambda: len(self._events) >= count.calls, "published events are not received")
        return list(self._events)

    def total_force(self) -> float:
        """What the whole skin feels, in N."""
        return float(self.world.simulation.skin.frame.force.sum())

    def spot(self, field: Field) -> Floats:
        """Where the centre of a field is in the world."""
        limb = self.part.limb(field.limb)
        body = self.data.body(limb.body)
        return body.xpos + body.xmat.reshape(3, 3) @ limb.to_body(field.centre)

    def put_finger(self, field: Field, off: float, along: float, finger: str = FINGER) -> None:
        """Put it `off` before the skin at the field's centre, or `along` the limb, at rest."""
        goal = finger_geometry.before_skin(
            self.model, self.data, self.part, field, off, along, finger
        )
        self.fingers[finger].setControlMode([], ARM.interfaces.ControlMode.Idle)
        self._slide(finger, goal - finger_geometry.point(self.data, finger))
        self.run(0.02)
        self.fingers[finger].setControlMode([], ARM.interfaces.ControlMode.Position)

    def press(self, field: Field, deep: float, along: float = 0.0, finger: str = FINGER) -> None:
        """Send the finger in along the normal; it takes about 0.1 s, and stays."""
        self.put_finger(field, 0.003, along, finger)
        step = (0.003 + deep) * finger_geometry.inwards(self.data, self.part, field)
        self.fingers[finger].setReferenceSpeed([], np.maximum(np.abs(step) / 0.1, 1e-3))
        self.fingers[finger].relativeMove([], step)

    def remove_fingers(self) -> None:
        """Where they wait for the first touch; motors are off, or they would bring them back."""
        for finger, board in self.fingers.items():
            board.setControlMode([], ARM.interfaces.ControlMode.Idle)
            joints = [self.model.joint(name).qposadr[0] for name in finger_geometry.slides(finger)]
            self._slide(finger, self._start[joints] - self.data.qpos[joints])

    def _slide(self, finger: str, way: Floats) -> None:
        for name, step in zip(finger_geometry.slides(finger), way, strict=True):
            self.data.joint(name).qpos[0] += step
            self.data.joint(name).qvel[0] = 0.0
        mujoco.mj_forward(self.model, self.data)

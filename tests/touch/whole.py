"""The shipped simulator of a robot, generic_arm and reflex, as they are, in one process.

They live in lock-step, so that a test sees the same each time and as fast as it can be. The fingers
are the simulator's own: one is put before a place and then moved by its control board.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import fingertip
import mujoco
import numpy as np
import shipped_component
from puppet import REFLEX, proxy_of, words
from stepped import DEADLINE, Cast, Stage, Stepped

from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware.base import Endpoint
from robocomp_dsl.runtime.settings import RunSettings
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.located import UNITS
from robocomp_dsl.tactile.description.read import load_robot
from robocomp_dsl.tactile.reflex.law import Field

BOARDS = {
    ("nao", "left_arm"): "LArm",
    ("nao", "right_arm"): "RArm",
    ("icub", "left_arm"): "left_arm",
    ("icub", "right_arm"): "right_arm",
}
ARM = shipped_component.load("generic_arm")
FINGER = fingertip.FINGERS[0]


def held(worker: Any) -> Any:
    """The simulator, but its time goes on only when the test says so."""

    class Held(Stepped, worker):  # type: ignore[misc]
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

    return Held


class Whole(Stage):
    """`said` are parameters of the reflex. The arm has gone to its start pose."""

    def __init__(self, robot: str, side: str, **said: object) -> None:
        self.name, self.side = f"{robot}_simulator", side
        simulator = shipped_component.load(self.name)
        description = Path(simulator.folder) / "tactile.yaml"
        self.part = load_robot(description).part(side)
        both = (f"description={description}", f"part={side}")
        wires = {"board": (f"{self.name}.{BOARDS[robot, side]}",)}
        super().__init__(
            Cast(held(simulator.worker), ("speed=0",)),
            Cast(ARM.worker, (*both, "begin=start"), RunSettings(wires=wires)),
            Cast(REFLEX.worker, (*both, *(f"{k}={v}" for k, v in said.items()))),
        )
        self.reflex = self.proxy(proxy_of(words.REFLEX), "reflex", "Reflex")
        board = proxy_of(ARM.interfaces.CONTROLBOARD)
        self.fingers = {one: self.proxy(board, self.name, one) for one in fingertip.FINGERS}
        self._events: list[Any] = []
        at = Endpoint(words.REFLEXEVENTS, "looker", "ReflexEvents")
        self._middleware.subscribe(at, {"reflex": self._events.append}, Execution())
        self.arm = self.proxy(proxy_of(words.GENERICARM), "generic_arm", "GenericArm")
        simulation = self.world.simulation
        self.model, self.data = simulation.world.model, simulation.world.data
        self._start = self.data.qpos.copy()

    @property
    def state(self) -> str:
        (state,) = self.worker(1).machine.states
        return str(state)

    def params(self, **said: float) -> None:
        """Other parameters of the reflex."""
        self.worker(1).params.set(said)

    def field(self, name: str) -> Field:
        return next(one for one in self.part.fields if one.name == name)

    def until(self, state: str, seconds: float = 10.0) -> None:
        end = self.world.clock.now() + seconds
        while self.state != state:
            assert self.world.clock.now() < end, f"still {self.state}: {self.worker(1).reason}"
            self.run(0.02)

    def joints(self) -> tuple[Floats, Floats]:
        """Angles and speeds (t, m) that the arm's own joints have had so far, as shares.

        0 and 1 are the limits of an angle; 1 is the largest speed.
        """
        made = [servo for servo in self.part.servos if servo.joint]
        joints = [self.model.joint(servo.joint) for servo in made]
        angles = np.array([q[[j.qposadr[0] for j in joints]] for q, _ in self.world.recorded])
        speeds = np.array([v[[j.dofadr[0] for j in joints]] for _, v in self.world.recorded])
        unit = np.array([UNITS[servo.unit] for servo in made])
        low, high = (unit * [getattr(s, end) for s in made] for end in ("low", "high"))
        return (angles - low) / (high - low), np.abs(speeds) / (unit * [s.speed for s in made])

    def events(self) -> list[Any]:
        """What fields have answered so far; an onlooker hears it a moment later."""
        count = self.runners[1].statistics.of("ReflexEvents", "reflex")
        end = time.monotonic() + DEADLINE
        while len(self._events) < count.calls:
            assert time.monotonic() < end, "events were published and not heard"
            time.sleep(0.001)
        return list(self._events)

    def felt(self) -> float:
        """What the whole skin feels, in N."""
        return float(self.world.simulation.skin.frame.force.sum())

    def spot(self, field: Field) -> Floats:
        """Where the centre of a field is in the world."""
        limb = self.part.limb(field.limb)
        body = self.data.body(limb.body)
        return body.xpos + body.xmat.reshape(3, 3) @ limb.to_body(field.centre)

    def put_finger(self, field: Field, off: float, along: float, finger: str = FINGER) -> None:
        """Put it `off` before the skin at the field's centre, or `along` the limb, at rest."""
        goal = fingertip.before_skin(self.model, self.data, self.part, field, off, along, finger)
        self.fingers[finger].setControlMode([], ARM.interfaces.ControlMode.Idle)
        self._slide(finger, goal - fingertip.point(self.data, finger))
        self.run(0.02)
        self.fingers[finger].setControlMode([], ARM.interfaces.ControlMode.Position)

    def press(self, field: Field, deep: float, along: float = 0.0, finger: str = FINGER) -> None:
        """Send the finger in along the normal; it takes about 0.1 s, and stays."""
        self.put_finger(field, 0.003, along, finger)
        step = (0.003 + deep) * fingertip.inwards(self.data, self.part, field)
        self.fingers[finger].setReferenceSpeed([], np.maximum(np.abs(step) / 0.1, 1e-3))
        self.fingers[finger].relativeMove([], step)

    def take_away(self) -> None:
        """Where they wait for the first touch; motors are off, or they would bring them back."""
        for finger, board in self.fingers.items():
            board.setControlMode([], ARM.interfaces.ControlMode.Idle)
            joints = [self.model.joint(name).qposadr[0] for name in fingertip.slides(finger)]
            self._slide(finger, self._start[joints] - self.data.qpos[joints])

    def _slide(self, finger: str, way: Floats) -> None:
        for name, step in zip(fingertip.slides(finger), way, strict=True):
            self.data.joint(name).qpos[0] += step
            self.data.joint(name).qvel[0] = 0.0
        mujoco.mj_forward(self.model, self.data)

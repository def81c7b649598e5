"""A kinematic robot: the generic arm and the skin of a description, controlled by a test.

The arm moves to the commanded position at the commanded speed; the test sets the forces of the
skin. It serves and publishes the real interfaces with the geometry of the real description.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partialmethod
from pathlib import Path
from typing import Any

import numpy as np

from robocomp_dsl.runtime import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.time.clock_interface import ClockProxy
from robocomp_dsl.simulation.robots import catalog
from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arm.generic_arm import GenericArm
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.reflex import law
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from tests.touch import shipped_component
from tests.touch.lockstep_harness import TICK, ComponentSetup, LockstepHarness, SteppedClockSource

REFLEX = shipped_component.load("reflex")
interfaces = REFLEX.interfaces
DESCRIPTIONS = Path(catalog.__file__).parent / "descriptions"


def geometry_to_message(geometry: SkinGeometry) -> Any:
    """A geometry in the interfaces of Skin.idsl."""
    columns = dict(zip(("x", "y", "z"), geometry.points.T.astype(np.float32), strict=True))
    columns |= dict(zip(("nx", "ny", "nz"), geometry.normals.T.astype(np.float32), strict=True))
    rows = [f"r{i}{j}" for i in range(3) for j in range(3)]
    return interfaces.Geometry(
        version=geometry.version,
        id=geometry.ids.astype(np.int32),
        patch=geometry.patch.astype(np.int32),
        limb=geometry.limb.astype(np.int32),
        patches=[
            interfaces.Patch(name, sensitivity.gain, sensitivity.floor, sensitivity.saturation)
            for name, sensitivity in zip(geometry.patches, geometry.sensitivities, strict=True)
        ],
        limbs=[
            interfaces.Limb(
                name=name,
                body=limb.body,
                **dict(zip(("x", "y", "z"), limb.origin.tolist(), strict=True)),
                **dict(zip(rows, limb.axes.ravel().tolist(), strict=True)),
            )
            for name, limb in zip(geometry.limbs, geometry.frames, strict=True)
        ],
        **columns,
    )


def proxy_of(interface: rt.Interface) -> type[rt.Proxy]:
    """What generated code would have for a port of this interface."""

    methods = {
        operation.name: partialmethod(rt.Proxy._call, operation.name)
        for operation in interface.operations
    }
    return type(f"{interface.name}Proxy", (rt.Proxy,), {"INTERFACE": interface, **methods})


ROBOTS = ("nao_h25", "icub_v2")
ARMS = [(robot, side) for robot in ROBOTS for side in ("left_arm", "right_arm")]


def with_fields(message: Any, **fields: object) -> Any:
    """The message, after its fields have been set to these values."""
    for name, value in fields.items():
        setattr(message, name, value)
    return message


class Robot(SteppedClockSource):
    """Serves an arm and a skin. Subclasses define its motion and the forces of its skin.

    `name_of_robot` and `side` are set in a subclass, see `of`.
    """

    name_of_robot, side = "nao_h25", "left_arm"
    SPEC = ComponentSpec(
        name="robot",
        period=round(TICK * 1000),
        middleware="inproc",
        implements=(
            ServedPort(
                "GenericArm",
                interfaces.GENERICARM,
                {"getLimits": "limits", "move": "move", "stop": "stop"},
            ),
            ServedPort("Skin", interfaces.SKIN, {"getGeometry": "get_geometry"}),
        ),
        publishes=(
            CalledPort("SkinFrame", proxy_of(interfaces.SKINFRAME), "frames_proxy"),
            CalledPort("GenericArmState", proxy_of(interfaces.GENERICARMSTATE), "states_proxy"),
            CalledPort("Clock", ClockProxy, "clock_proxy"),
        ),
        subscribes=(
            ServedPort(
                "ReflexEvents",
                interfaces.REFLEXEVENTS,
                dict.fromkeys(("reflex", "limited", "stateChanged"), "record_event"),
            ),
        ),
    )
    frames_proxy: Any
    states_proxy: Any

    @classmethod
    def of(cls, robot: str, side: str) -> type[Robot]:
        return type("ThisRobot", (cls,), {"name_of_robot": robot, "side": side})

    def initialize(self) -> None:
        super().initialize()
        robot = self.describe()
        self.part = robot.part(self.side)
        self.arm, self.geometry = GenericArm(self.part), SkinGeometry.of(robot)
        self.rest = self.part.start
        self.sequence = self.geometry_requests = self.stops = 0
        self.publishes_skin = self.publishes_state = self.answers = True
        self.alter_frame: Callable[[Any], Any] = lambda frame: frame
        self.moves: list[tuple[float, Floats, Floats]] = []
        self.poses: list[Floats] = []
        self.reflex_messages: list[Any] = []
        self.frames: dict[float, Floats] = {}

    def describe(self) -> RobotDescription:
        """The description of the robot, which subclasses may have from elsewhere."""
        return description(self.name_of_robot)

    def advance(self) -> Floats:
        """Let `TICK` pass; where the arm is then (n,)."""
        raise NotImplementedError

    def taxel_forces(self) -> Floats:
        """The forces of the taxels."""
        raise NotImplementedError

    def tick(self) -> None:
        """Advance, publish the state of the arm and a frame of the skin."""
        pose, now = self.advance(), self.clock.now()
        self.poses.append(pose)
        if self.publishes_state:
            none = np.zeros(len(pose))
            self.states_proxy.armState(interfaces.ArmState(now, pose, none, none, moving=False))
        self.sequence += 1
        forces = self.taxel_forces().astype(np.float32)
        self.frames[now] = forces
        frame = interfaces.Frame(self.sequence, now, self.geometry.version, forces)
        frame = self.alter_frame(frame) if self.publishes_skin else None
        if frame is not None:
            self.frames_proxy.frame(frame)

    def record_event(self, message: Any) -> None:
        """An event or a state of the reflex."""
        self.reflex_messages.append(message)

    # What it serves.

    def get_geometry(self) -> Any:
        self.geometry_requests += 1
        return geometry_to_message(self.geometry)

    def limits(self) -> Any:
        self.answer()
        arm = self.arm
        return interfaces.ArmLimits(
            arm.low, arm.high, arm.speed_limits, self.rest, arm.mapping.available
        )

    def move(self, position: Floats, speed: Floats) -> Any:
        self.answer()
        self.moves.append((self.clock.now(), position, speed))
        return interfaces.Outcome()

    def stop(self) -> None:
        self.answer()
        self.stops += 1

    def answer(self) -> None:
        if not self.answers:
            raise RuntimeError("the cable is out")


class KinematicRobot(Robot):
    """See the module."""

    def initialize(self) -> None:
        super().initialize()
        self.pose = self.goal = self.rest
        self.speed = np.zeros(len(self.pose))
        self.forces = np.zeros(self.geometry.size)

    def advance(self) -> Floats:
        step = np.clip(self.goal - self.pose, -self.speed * TICK, self.speed * TICK)
        self.pose = self.pose + step
        return self.pose

    def taxel_forces(self) -> Floats:
        return self.forces

    def move(self, position: Floats, speed: Floats) -> Any:
        outcome = super().move(position, speed)
        self.goal, self.speed = position, speed
        return outcome

    def stop(self) -> None:
        super().stop()
        self.goal = self.pose


class CentredRobot(KinematicRobot):
    """A robot whose start pose is in the middle of its joints, where no limit is near."""

    def initialize(self) -> None:
        super().initialize()
        self.rest = self.pose = self.goal = (self.arm.low + self.arm.high) / 2


class ReflexHarness(LockstepHarness):
    """A reflex and a robot. `params` are parameters of the reflex, as on its command line."""

    def __init__(
        self,
        robot: str = "nao_h25",
        side: str = "left_arm",
        kind: type[Robot] = KinematicRobot,
        **params: object,
    ) -> None:
        values = {"description": DESCRIPTIONS / f"{robot}.yaml", "part": side, **params}
        overrides = tuple(f"{key}={value}" for key, value in values.items())
        super().__init__(
            ComponentSetup(kind.of(robot, side)), ComponentSetup(REFLEX.worker, overrides)
        )
        self.reflex = self.proxy(proxy_of(interfaces.REFLEX), "reflex", "Reflex")

    @property
    def robot(self) -> Any:
        return self.world

    @property
    def state(self) -> str:
        """The one active state of the machine."""
        (state,) = self.worker().machine.states
        return state

    def run_until(self, state: str, seconds: float = 10.0) -> None:
        """Let time pass until it is in this state."""
        end = self.world.clock.now() + seconds
        while self.state != state:
            assert self.world.clock.now() < end, f"still {self.state}: {self.worker().reason}"
            self.run(TICK)

    def wait_until_watching(self) -> ReflexHarness:
        """Let it find skin and arm."""
        self.run(0.7)
        assert self.state == "Watching", self.worker().reason
        return self

    def field(self, name: str) -> law.Field:
        return next(field for field in self.robot.part.fields if field.name == name)

    def taxels_near(self, field: law.Field, distance: float) -> Bools:
        """The taxels on the field's limb that are nearer than this to its centre."""
        geometry = self.robot.geometry
        limb = geometry.limbs.index(f"{self.robot.side}/{field.limb}")
        away = np.linalg.norm(geometry.points - field.centre, axis=1)
        return (geometry.limb == limb) & (away < distance)

    def press(self, name: str, newtons: float, distance: float = 0.01) -> None:
        """All taxels near the centre of a field feel so much, until something else is pressed."""
        self.robot.forces = np.where(self.taxels_near(self.field(name), distance), newtons, 0.0)

    def release(self) -> None:
        self.robot.forces = np.zeros(self.robot.geometry.size)

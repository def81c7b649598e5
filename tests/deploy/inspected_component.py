"""A component that runs in the process of the test, over zenoh, for `rcdeploy echo` and others."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.parameters import Parameters


class Mode(rt.Enum):
    Idle = 0
    Moving = 1


class Point(rt.Struct):
    x: rt.Double = 0.0
    y: rt.Float = 0.0


class Pose(rt.Struct):
    serial: rt.Int = 0
    name: rt.String = ""
    mode: Mode = Mode.Idle
    points: list[Point] = rt.default()
    ranges: rt.Float32Array = rt.default()
    limits: dict[rt.String, rt.Int] = rt.default()
    is_valid: rt.Bool = False


class Rejected(rt.DeclaredError):
    reason: rt.String = ""


FEED = rt.Interface("Test::Feed", rt.Operation("pose", rt.Pattern.PUBLISH, inputs={"pose": Pose}))
EVENTS = rt.Interface(
    "Test::Events",
    rt.Operation("started", rt.Pattern.PUBLISH, inputs={"who": rt.String, "count": rt.Int}),
    rt.Operation("ended", rt.Pattern.PUBLISH),
)
ARM = rt.Interface(
    "Test::Arm",
    rt.Operation("move", inputs={"to": Point, "speed": rt.Float, "mode": Mode}, returns=Pose),
    rt.Operation("reject", inputs={"reason": rt.String}, throws=(Rejected,)),
    rt.Operation("flag", inputs={"value": rt.Bool, "bytes": rt.UInt8Array}, returns=rt.String),
    rt.Operation("limits", inputs={"limits": dict[Mode, rt.Short]}, returns=dict[Mode, rt.Short]),
    rt.Operation("halt", rt.Pattern.COMMAND),
)


class FeedProxy(rt.Proxy):
    INTERFACE = FEED

    def pose(self, pose: Pose) -> None:
        self._call("pose", pose)


class EventsProxy(rt.Proxy):
    INTERFACE = EVENTS


class InspectedArm(Component):
    """Publishes a pose every 5 ms, answers calls, and keeps the poses that it receives."""

    SPEC = ComponentSpec(
        name="arm",
        period=5,
        implements=(ServedPort("Arm", ARM, {each.name: each.name for each in ARM.operations}),),
        publishes=(
            CalledPort("Feed", FeedProxy, "feed_proxy"),
            CalledPort("Events", EventsProxy, "events_proxy"),
        ),
        subscribes=(ServedPort("Goal", FEED, {"pose": "receive"}),),
    )
    feed_proxy: FeedProxy
    serial = 0

    def __init__(self) -> None:
        self.received: list[Pose] = []
        self.halted = threading.Event()

    def compute(self) -> None:
        self.serial += 1
        points = [Point(1.0, 2.0), Point(float("inf"), 0.1)]
        pose = Pose(self.serial, "left arm", Mode.Moving, points, [0.1] * 3, {"a": 1}, True)
        self.feed_proxy.pose(pose)

    def move(self, to: Point, speed: float, mode: Mode) -> Pose:
        return Pose(1, f"{to.x} {to.y} {speed}", mode)

    def reject(self, reason: str) -> None:
        raise Rejected(reason)

    def flag(self, value: bool, bytes: rt.UInt8Array) -> str:
        return f"{value} {bytes.tolist()}"

    def limits(self, limits: dict[Mode, int]) -> dict[Mode, int]:
        return limits

    def halt(self) -> None:
        self.halted.set()

    def receive(self, pose: Pose) -> None:
        if pose.name != "left arm":
            self.received.append(pose)


@contextmanager
def run_inspected_arm(domain: str) -> Iterator[InspectedArm]:
    """The component runs until the end of the block."""
    runner = Runner(InspectedArm, Parameters(), RunSettings(domain=domain))
    runner.start()
    try:
        assert isinstance(runner.worker, InspectedArm)
        yield runner.worker
    finally:
        runner.stop()
        assert runner.wait()


if __name__ == "__main__":
    with run_inspected_arm(sys.argv[1]):
        sys.stdin.read()

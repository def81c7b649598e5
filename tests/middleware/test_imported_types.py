"""Types of Thrift and Bottle definitions travel over every kind of transport."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.codec import codec
from tests.generate.golden_cases import GOLDEN
from tests.middleware.network import DEADLINE, Network
from tests.support.waiting import wait_until

GENERATED = GOLDEN / "thrift" / "expected" / "eyes_generated" / "interfaces.py"


@pytest.fixture(scope="module")
def generated() -> Any:
    """The generated types and interfaces of the golden component `eyes`."""
    module = ModuleType("imported_types_interfaces")
    sys.modules[module.__name__] = module
    exec(compile(GENERATED.read_text("utf-8"), str(GENERATED), "exec"), vars(module))
    return module


@pytest.fixture(params=["inproc", "zenoh", "yarp"])
def network(request: pytest.FixtureRequest) -> Iterator[Network]:
    opened = Network(request.param)
    yield opened
    opened.close()


def status(generated: Any) -> Any:
    """A value with something in every field."""
    return generated.Status(
        position=1.5,
        velocity=-0.25,
        mode=generated.Mode.POSITION,
        limits=generated.ListOfLimits([generated.Limits(-1.0, 2.0), generated.Limits()]),
        counts={"left": np.array([1, -2], np.int32), "none": np.array([], np.int32)},
        raw=np.array([0, 255, 10], np.uint8),
        torques=np.array([0.5, 1e300]),
    )


def test_thrift_types_in_calls(network: Network, generated: Any) -> None:
    sent, received = status(generated), []
    handlers = {
        "get_version": lambda: "1.0 ñ",
        "move_to": lambda angle, speed: angle < speed,
        "follow": lambda path, names: path * len(names),
        "stop": lambda: received.append("stop"),
        "get_status": lambda: sent,
        "reset": lambda: received.append("reset"),
    }
    network.node("motor").serve(handlers, generated.MOTOR, "Motor")
    node = network.node("caller")
    channel = node.ports.proxy(node.at(generated.MOTOR, "Motor"))
    assert channel.wait(DEADLINE)
    motor = generated.MotorProxy(channel)
    assert motor.get_version() == "1.0 ñ"
    assert (motor.move_to(1.0, 2.0), motor.move_to(2.0, 1.0)) == (True, False)
    assert motor.follow(np.array([1.5, -2.0]), ["a", "b"]).tolist() == [3.0, -4.0]
    assert codec.encode(motor.get_status()) == codec.encode(sent)
    motor.reset()
    motor.stop()
    wait_until(lambda: received == ["reset", "stop"])


def test_bottle_types_in_publications(network: Network, generated: Any) -> None:
    received: list[Any] = []
    subscriber = network.node("subscriber")
    subscriber.ports.subscribe(
        subscriber.at(generated.EYES, "Eyes"), {"look": received.append}, subscriber.execution
    )
    publisher = network.node("publisher")
    channel = publisher.ports.advertise(publisher.at(generated.EYES, "Eyes"))
    proxy = generated.EyesProxy(channel)
    wait_until(proxy.has_subscribers)
    value = generated.gaze(
        0.5, generated.gaze_target(1.0, 2.0), [generated.gaze_names("a"), generated.gaze_names("")]
    )
    proxy.look(value)
    wait_until(lambda: bool(received))
    assert codec.encode(received[0]) == codec.encode(value)

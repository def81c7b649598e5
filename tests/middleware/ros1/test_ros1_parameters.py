"""The parameters of a component on the parameter server of a real ROS master."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.shown_parameters import ShownParameters
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.ros1.parameters import ros_value
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApiError
from robocomp_dsl.runtime.parameters import Parameter
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.runtime.arm_parameters import ArmParams
from tests.support.waiting import wait_until


class LampParams(ArmParams):
    """Also with lists of values."""

    SCHEMA = (
        *ArmParams.SCHEMA,
        Parameter("weights", "float", default=(1.0,), shortest=1, longest=4, high=10, live=True),
        Parameter("names", "string", default=(), shortest=0, longest=2, live=True),
    )
    weights: list[float]
    names: list[str]


@pytest.fixture
def params(tmp_path: Path, own_master: Master) -> Iterator[LampParams]:
    """The parameters of the running component `/left/arm`."""
    config = tmp_path / "arm.toml"
    config.write_text('rate = 20.0\n[[motors]]\nname = "elbow"\n')
    loaded = LampParams.load(config)
    group = CallbackGroup()
    context = ComponentContext(
        "left/arm",
        "test-ros1-parameters",
        group,
        Statistics(),
        transport_settings={("ros1", "master"): own_master.uri},
        parameters=ShownParameters(loaded, group),
    )
    ports = open_ports("ros1", context)
    assert ports.transport("ros1")
    yield loaded
    ports.close()


def value(master: Master, name: str) -> object:
    try:
        return master.ask("getParam", f"/left/arm/{name}")
    except RosApiError:
        return None


@pytest.mark.peers
@needs_ros1
def test_parameters_are_shown_and_changed(
    params: LampParams, own_master: Master, caplog: pytest.LogCaptureFixture
) -> None:
    master = own_master
    wait_until(lambda: value(master, "motors/0/limits/high") == 1.0)
    assert value(master, "rate") == 20.0
    assert value(master, "motors/0/name") == "elbow"
    assert value(master, "verbose") is False
    params.set({"rate": 30.0})
    wait_until(lambda: value(master, "rate") == 30.0)
    master.run("rosparam", "set", "/left/arm/rate", "40")
    wait_until(lambda: params.rate == 40.0)
    master.run("rosparam", "set", "/left/arm/rate", "5000")
    wait_until(lambda: "rosparam set /left/arm/rate" in caplog.text)
    wait_until(lambda: value(master, "rate") == 40.0)
    assert value(master, "weights") == [1.0]
    master.run("rosparam", "set", "/left/arm/weights", "[2, 3.5]")
    wait_until(lambda: params.weights == [2.0, 3.5])
    master.run("rosparam", "set", "/left/arm/names", '["a, b", c]')
    wait_until(lambda: params.names == ["a, b", "c"])
    params.set({"weights": [4.0]})
    wait_until(lambda: value(master, "weights") == [4.0])
    master.run("rosparam", "set", "/left/arm/weights", "[20]")
    wait_until(lambda: "weights[0]" in caplog.text)
    peer = RospyPeer(master, "setter")
    try:
        peer.command("set_parameter", "/left/arm/retries", 7)
        wait_until(lambda: value(master, "retries") == 3)
        assert peer.command("parameter", "/left/arm/mode") == "position"
    finally:
        peer.close()
    assert params.retries == 3
    master.stop()
    master.start()
    wait_until(lambda: value(master, "rate") == 40.0)


def test_ros_value_of_large_integers_is_text() -> None:
    assert ros_value(2**40) == str(2**40)
    assert ros_value([1, {"a": 2.5}]) == [1, {"a": 2.5}]
    assert ros_value(True) is True

from __future__ import annotations

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.middleware.ros_common.interface_types import (
    NotRosType,
    check_interface,
    require_ros_types,
    service_type,
    topic_type,
)
from tests.middleware.ros2.ros_messages import (
    BASE,
    CHAT,
    SCAN,
    SetBoolRequest,
    SetBoolResponse,
    String,
    TriggerResponse,
)


class Plain(rt.Struct, type_id="RoboCompLaser::Plain"):
    x: rt.Double = 0.0


class Color(rt.Enum):
    Red = 0


class Painted(rt.Struct, type_id="paint_msgs/msg/Painted"):
    color: Color = Color.Red


class Table(rt.Struct, type_id="paint_msgs/msg/Table"):
    entries: dict[rt.String, rt.Int] = rt.default()


class Scene(rt.Struct, type_id="paint_msgs/msg/Scene"):
    parts: list[Plain] = rt.default()


class Failed(rt.DeclaredError):
    code: rt.Int = 0


def _publication(**inputs: object) -> rt.Interface:
    return rt.Interface("M::I", rt.Operation("op", rt.Pattern.PUBLISH, inputs))


def test_topic_type_is_that_of_its_only_input() -> None:
    assert topic_type(CHAT.operations[0]).type_id == "std_msgs/msg/String"
    assert topic_type(SCAN.operations[0]).type_id == "sensor_msgs/msg/LaserScan"


def test_service_type_has_the_name_of_request_and_response() -> None:
    service = service_type(BASE.operation("stop"))
    assert (service.type_id, service.response) == ("std_srvs/srv/Trigger", TriggerResponse)


def test_check_interface_accepts_messages_services_and_commands() -> None:
    assert check_interface(BASE) == []
    assert check_interface(SCAN, published=True) == []


@pytest.mark.parametrize(
    ("interface", "reason"),
    [
        (_publication(), "it has 0 inputs instead of one"),
        (_publication(a=String, b=String), "it has 2 inputs instead of one"),
        (_publication(a=rt.Int), "its input is no ROS message"),
        (_publication(a=Plain), "its input Plain is not imported from a .msg or .srv file"),
        (_publication(a=Painted), "Painted.color is an enum, which ROS messages lack"),
        (_publication(a=Table), "Table.entries is a dictionary, which ROS messages lack"),
        (_publication(a=Scene), "Scene.parts is of type Plain, which is not imported"),
    ],
)
def test_check_interface_tells_why_a_topic_is_refused(interface: rt.Interface, reason: str) -> None:
    (text,) = check_interface(interface, published=True)
    assert text.startswith("op: ")
    assert reason in text


@pytest.mark.parametrize(
    ("operation", "reason"),
    [
        (rt.Operation("op", inputs={"a": SetBoolRequest}), "it has 0 results instead of one"),
        (
            rt.Operation("op", inputs={"a": SetBoolRequest}, returns=TriggerResponse),
            "are not request and response of one ROS service",
        ),
        (
            rt.Operation("op", inputs={"a": String}, returns=String),
            "are not request and response of one ROS service",
        ),
        (
            rt.Operation(
                "op", inputs={"a": SetBoolRequest}, returns=SetBoolResponse, throws=(Failed,)
            ),
            "it throws Failed, but a ROS service has no exceptions",
        ),
    ],
)
def test_check_interface_tells_why_a_service_is_refused(
    operation: rt.Operation, reason: str
) -> None:
    (text,) = check_interface(rt.Interface("M::I", operation))
    assert reason in text


def test_require_ros_types_names_port_interface_and_all_reasons() -> None:
    interface = rt.Interface(
        "M::I", rt.Operation("a", inputs={"x": rt.Int}), rt.Operation("b", inputs={"x": rt.Int})
    )
    with pytest.raises(NotRosType, match=r"^Port: ROS 2 cannot express M::I: a: .*; b: "):
        require_ros_types(interface, "Port", published=False)

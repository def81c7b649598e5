"""Services between components of ours on the middlewares of ROS 2 that have them."""

from __future__ import annotations

import threading

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.errors import InterfaceMismatch, MiddlewareError, NoServer, Timeout
from tests.middleware.network import DEADLINE
from tests.middleware.ros2.ros_messages import (
    BASE,
    OTHER_SWITCH,
    SWITCH,
    SetBoolRequest,
    SetBoolResponse,
    String,
    TriggerRequest,
    TriggerResponse,
)
from tests.middleware.ros2.ros_network import RosNetwork
from tests.support.waiting import wait_until


def _set(request: SetBoolRequest) -> SetBoolResponse:
    return SetBoolResponse(request.data, "ünder" * request.data)


def test_service_of_a_component_is_called(service_network: RosNetwork) -> None:
    service_network.component("lamp").serve(SWITCH, {"set": _set}, "Switch")
    user = service_network.component("user")
    reply = user.answered(SWITCH, "set", "Switch", request=SetBoolRequest(True))
    assert reply == SetBoolResponse(True, "ünder")
    reply = user.answered(SWITCH, "set", "Switch", request=SetBoolRequest(False))
    assert reply == SetBoolResponse(False, "")


def test_service_port_with_several_operations_has_a_name_for_each(
    service_network: RosNetwork,
) -> None:
    texts: list[str] = []
    base = service_network.component("base", Base="/robot")
    base.serve(
        BASE,
        {
            "enable": _set,
            "stop": lambda _: TriggerResponse(True, "stopped"),
            "say": lambda text: texts.append(text.data),
        },
        "Base",
    )
    user = service_network.component("user")
    reply = user.answered(BASE, "enable", "Base", "/robot", request=SetBoolRequest(True))
    assert reply.success
    reply = user.answered(BASE, "stop", "Base", request=TriggerRequest())
    assert reply == TriggerResponse(True, "stopped")
    user.caller(BASE, "say", "Base")(String("hello"))
    wait_until(lambda: texts == ["hello"])


def test_service_handlers_of_two_components_call_each_other(service_network: RosNetwork) -> None:
    left, right = service_network.component("left"), service_network.component("right")
    call_left = right.caller(SWITCH, "set", "Switch", "left", timeout=1.0)
    call_right = left.caller(SWITCH, "set", "Switch", "right", timeout=2.0)

    def ask_right(request: SetBoolRequest) -> SetBoolResponse:
        return call_right(request) if request.data else SetBoolResponse(True, "left")

    left.serve(SWITCH, {"set": ask_right}, "Switch")
    right.serve(SWITCH, {"set": lambda _: call_left(SetBoolRequest(False))}, "Switch")
    user = service_network.component("user")
    reply = user.answered(SWITCH, "set", "Switch", "left", request=SetBoolRequest(True))
    assert reply.message == "left"


def test_service_calls_of_several_threads_get_their_own_replies(
    service_network: RosNetwork,
) -> None:
    service_network.component("lamp", threads=4).serve(SWITCH, {"set": _set}, "Switch")
    call = service_network.component("user", threads=4).caller(SWITCH, "set", "Switch")
    wait_until(lambda: call(SetBoolRequest(True)), ignoring=Timeout)
    replies: list[bool] = []

    def repeat(data: bool) -> None:
        replies.extend(call(SetBoolRequest(data)).success is data for _ in range(50))

    threads = [threading.Thread(target=repeat, args=(i % 2 == 0,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(DEADLINE)
    assert replies == [True] * 200


def test_service_call_ends_when_the_component_stops(service_network: RosNetwork) -> None:
    entered, release = threading.Event(), threading.Event()

    def block(_: SetBoolRequest) -> SetBoolResponse:
        entered.set()
        release.wait(DEADLINE)
        return SetBoolResponse()

    service_network.component("lamp").serve(SWITCH, {"set": block}, "Switch")
    user = service_network.component("user")
    call = user.caller(SWITCH, "set", "Switch", timeout=DEADLINE)
    errors: list[BaseException] = []

    def ask() -> None:
        try:
            call(SetBoolRequest(True))
        except NoServer as error:
            errors.append(error)

    thread = threading.Thread(target=ask)
    thread.start()
    assert entered.wait(DEADLINE)
    user.ports.interrupt()
    thread.join(DEADLINE)
    release.set()
    assert len(errors) == 1


def test_service_that_nobody_offers_is_named(service_network: RosNetwork) -> None:
    user = service_network.component("user")
    call = user.caller(SWITCH, "set", "Switch", "/nobody", timeout=0.5)
    with pytest.raises(NoServer, match=r"/nobody .std_srvs/srv/SetBool"):
        call(SetBoolRequest(True))


def test_service_with_another_type_is_an_interface_mismatch(service_network: RosNetwork) -> None:
    lamp = service_network.component("lamp")
    lamp.serve(OTHER_SWITCH, {"set": lambda _: TriggerResponse()}, "Switch")
    user = service_network.component("user")
    call = user.caller(SWITCH, "set", "Switch", "/lamp/Switch", timeout=5.0)
    with pytest.raises(InterfaceMismatch, match=r"/lamp/Switch.*Trigger"):
        call(SetBoolRequest(True))


def test_service_of_several_inputs_is_refused_with_its_reason(service_network: RosNetwork) -> None:
    add = rt.Interface(
        "Robot::Adder", rt.Operation("add", inputs={"a": rt.Int, "b": rt.Int}, returns=rt.Int)
    )
    with pytest.raises(MiddlewareError, match=r"Adder: ROS 2 cannot express.*add: it has 2 inputs"):
        service_network.component("adder").serve(add, {"add": lambda a, b: a + b}, "Adder")

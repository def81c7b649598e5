"""Settings, addresses and ends of components on Ice."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from tests.middleware.ice.ice_component import IceComponent
from tests.middleware.ice.peers import free_port
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers


def test_unknown_setting_is_refused(component: Callable[..., IceComponent]) -> None:
    with pytest.raises(MiddlewareError, match=r"unknown setting `ice.Port`; known: TopicManager, "):
        component(transport_settings={("ice", "Port"): "5"})


def test_properties_of_ice_are_passed_on(
    component: Callable[..., IceComponent], generated: Any
) -> None:
    own = component(transport_settings={("ice", "Ice.Default.Host"): "127.0.0.1"})
    transport: Any = own.ports.transport("ice")
    assert transport._incoming.getProperties().getProperty("Ice.Default.Host") == "127.0.0.1"


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("10001", r"own\.Store: `10001` is no address of Ice; write such as `tcp -p 10001`"),
        ("tcp -h nohost.invalid -p 1", r"own\.Store: Ice cannot listen at `tcp -h nohost"),
        ("tcp -x", r"own\.Store: Ice cannot listen at `tcp -x`: .*-x"),
    ],
)
def test_wrong_address_is_reported(
    component: Callable[..., IceComponent], generated: Any, address: str, message: str
) -> None:
    own = component(addresses={("ice", "Store"): address})
    with pytest.raises(MiddlewareError, match=message):
        own.serve(generated.STORE, {})


def test_address_in_use_is_reported(component: Callable[..., IceComponent], generated: Any) -> None:
    address = f"tcp -h 127.0.0.1 -p {free_port()}"
    first = component("first", addresses={("ice", "Store"): address})
    first.serve(generated.STORE, {})
    second = component("second", addresses={("ice", "Store"): address})
    with pytest.raises(MiddlewareError, match=r"second\.Store: .*Address already in use"):
        second.serve(generated.STORE, {})


def test_ports_may_share_an_address(component: Callable[..., IceComponent], generated: Any) -> None:
    endpoints = f"tcp -h 127.0.0.1 -p {free_port()}"
    addresses = {("ice", "Store"): endpoints, ("ice", "StorePub"): f"news:{endpoints}"}
    own = component(addresses=addresses)
    own.serve(generated.STORE, {"list": lambda n: n + 1})
    received: list[int] = []
    own.subscribe(generated.STOREPUB, lambda _item, number: received.append(number))
    other = component("other")
    proxy = generated.StoreProxy(other.ports.proxy(other.endpoint(generated.STORE)))
    assert proxy.list_(1) == 2
    news = generated.StorePubProxy(other.ports.advertise(other.endpoint(generated.STOREPUB)))
    assert news.wait_for_server(30)
    news.changed(generated.Item("a"), 5)
    wait_until(lambda: received == [5])


SERVER = """
import sys, time, signal
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
PROBE = rt.Interface("Test::Probe", rt.Operation("block"), rt.Operation("ping"))
group = CallbackGroup()
ports = open_ports("ice", ComponentContext("server", sys.argv[1], group, Statistics()))
def block():
    print("blocking", flush=True)
    time.sleep(60)
at = Endpoint(PROBE, "server", "Probe", (), middlewares=("ice",))
ports.serve(at, {"block": block, "ping": lambda: None}, group)
print("ready", flush=True)
signal.pause()
"""


def test_kill_of_server_ends_call_at_once(
    component: Callable[..., IceComponent], domain: str
) -> None:
    from robocomp_dsl.runtime import types as rt  # noqa: PLC0415

    probe = rt.Interface("Test::Probe", rt.Operation("block"), rt.Operation("ping"))
    client = component("client")
    process = subprocess.Popen(
        [sys.executable, "-c", SERVER, domain], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        channel = client.ports.proxy(client.endpoint(probe))
        assert channel.wait(60)
        channel.timeout = 60.0
        with ThreadPoolExecutor(1) as pool:
            asked = pool.submit(channel.bind(probe.operation("block")))
            assert process.stdout.readline() == "blocking\n"
            os.kill(process.pid, signal.SIGKILL)
            with pytest.raises(NoServer, match="the component that served it exited"):
                asked.result(30)
    finally:
        process.kill()
        process.wait()
        if process.stdout:
            process.stdout.close()

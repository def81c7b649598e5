"""Payloads that are no messages, in every direction, between processes that agree on the interface.

The codec of an operation is replaced on one side, so that its payloads are malformed. A transport
with a codec of its own does not call it: such cases are skipped.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.errors import MalformedMessage, MiddlewareError
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import NEWS, PROBE
from tests.support.waiting import wait_until

PAYLOADS = {
    "empty": b"",
    "byte": b"\0",
    "header": b"\0\1\0\0",
    "half": b"\0\1\0\0\1\0\0\0",
    "ones": b"\xff" * 100,
    "random": random.Random(7).randbytes(3000),
    "length": b"\0\1\0\0\xff\xff\xff\x7f",
}
pytestmark = [
    pytest.mark.feature("Malformed messages"),
    pytest.mark.needs("between_processes"),
    pytest.mark.parametrize("payload", PAYLOADS.values(), ids=PAYLOADS),
]


class Forger:
    """A copy of an interface whose operation `name` encodes `payload` instead of values."""

    def __init__(self, interface: rt.Interface, name: str, codec: str, payload: bytes) -> None:
        self.used = False
        self._payload = payload
        operations = [self._copy(o, codec if o.name == name else "") for o in interface.operations]
        self.interface = rt.Interface(interface.name, *operations)
        assert self.interface.hash == interface.hash

    def _copy(self, operation: rt.Operation, codec: str) -> rt.Operation:
        copy = rt.Operation(operation.name, operation.pattern, idempotent=operation.idempotent)
        copy.inputs, copy.outputs, copy.throws = (
            operation.inputs, operation.outputs, operation.throws,
        )  # fmt: skip
        if codec:
            setattr(copy, codec, self._encode)
        return copy

    def _encode(self, _values: Any) -> bytes:
        self.used = True
        return self._payload

    def skip_if_unused(self, middleware: str) -> None:
        if not self.used:
            pytest.skip(f"{middleware}: its transport has a codec of its own")


@pytest.mark.needs("services")
def test_malformed_request_is_refused_and_counted(network: Network, payload: bytes) -> None:
    server = network.node("server")
    server.serve({"add": lambda a, b: a + b})
    forger = Forger(PROBE, "add", "encode_request", payload)
    client = network.node("client")
    add = _bind(client.ports.proxy(client.at(forger.interface, "Probe")), forger, "add")
    try:
        with pytest.raises(MiddlewareError) as caught:
            add(1, 2)
    except pytest.fail.Exception:
        forger.skip_if_unused(network.middleware)
        raise
    assert isinstance(caught.value, MalformedMessage)
    assert server.count("add").malformed == 1
    assert network.node("other").probe().add(1, 2) == 3


@pytest.mark.needs("services")
def test_malformed_command_is_counted_and_port_continues(network: Network, payload: bytes) -> None:
    received: list[str] = []
    server = network.node("server")
    server.serve({"note": received.append})
    forger = Forger(PROBE, "note", "encode_request", payload)
    client = network.node("client")
    _bind(client.ports.proxy(client.at(forger.interface, "Probe")), forger, "note")("text")
    forger.skip_if_unused(network.middleware)
    wait_until(lambda: server.count("note").malformed == 1)
    network.node("other").probe().note("still here")
    wait_until(lambda: received == ["still here"])


@pytest.mark.needs("services")
def test_malformed_reply_is_reported_to_caller(network: Network, payload: bytes) -> None:
    forger = Forger(PROBE, "divide", "encode_reply", payload)
    server = network.node("server")
    server.serve({"divide": divmod, "add": lambda a, b: a + b}, forger.interface)
    probe = network.node("client").probe()
    try:
        with pytest.raises(MalformedMessage):
            probe.divide(7, 2)
    except pytest.fail.Exception:
        forger.skip_if_unused(network.middleware)
        raise
    assert probe.add(1, 2) == 3
    assert not server.failures


@pytest.mark.needs("topics")
def test_malformed_publication_is_counted_and_subscription_continues(
    network: Network, payload: bytes
) -> None:
    received: list[str] = []
    subscriber = network.node("subscriber")
    subscriber.subscribe(lambda who, _n: received.append(who))
    forger = Forger(NEWS, "announced", "encode_request", payload)
    publisher = network.node("publisher")
    channel = publisher.ports.advertise(publisher.at(forger.interface, "News"))
    assert channel.wait(DEADLINE)
    announce = _bind(channel, forger, "announced")
    news = network.node("honest").news()
    announce("me", 1)
    forger.skip_if_unused(network.middleware)
    counts = subscriber.count("announced", "News")
    wait_until(lambda: announce("me", 1) or counts.malformed)
    wait_until(lambda: news.announced("still here", 1) or received)
    assert set(received) == {"still here"}
    assert not subscriber.failures


def _bind(channel: Any, forger: Forger, name: str) -> Callable[..., Any]:
    bound: Callable[..., Any] = channel.bind(forger.interface.operation(name))
    return bound

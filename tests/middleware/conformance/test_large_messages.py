"""Messages of 8 MB and 64 MB, in all directions; skipped above `max_message_bytes`."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

import numpy as np
import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.conformance.peer_launcher import Peer
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS
from tests.support.waiting import wait_until

SIZES = [
    pytest.param(8_000_000, id="8MB", marks=pytest.mark.needs("8100000")),
    pytest.param(64_000_000, id="64MB", marks=pytest.mark.needs("64100000")),
]
IMAGES = rt.Interface(
    "Test::Images",
    rt.Operation("taken", rt.Pattern.PUBLISH, {"number": rt.Int, "pixels": rt.UInt8Array}),
)
pytestmark = pytest.mark.feature("Large messages")


@pytest.mark.needs("services")
@pytest.mark.parametrize("size", SIZES)
def test_query_carries_large_arrays_both_ways(network: Network, size: int) -> None:
    network.node("server").serve(HANDLERS)
    probe = network.node("client").probe()
    probe.set_timeout(DEADLINE)
    sent = np.arange(size // 4, dtype=np.float32)
    assert np.array_equal(probe.echo(sent), sent)
    assert probe.add(1, 2) == 3


@pytest.mark.needs("topics")
@pytest.mark.parametrize("size", SIZES)
def test_publication_carries_large_arrays_to_several_subscribers(
    network: Network, size: int
) -> None:
    reliable = "reliable" in network.capabilities.qos
    received: dict[str, list[tuple[int, int, int]]] = {"a": [], "b": []}
    for name, into in received.items():
        node = network.node(name)
        node.ports.subscribe(
            node.at(IMAGES, "Images", qos=Qos(reliable, depth=2)),
            {"taken": lambda n, p, into=into: into.append((n, len(p), int(p[-1])))},
            node.execution,
        )
    publisher = network.node("publisher")
    channel = publisher.ports.advertise(publisher.at(IMAGES, "Images", qos=Qos(reliable)))
    taken = channel.bind(IMAGES.operation("taken"))
    small = np.zeros(1, np.uint8)
    wait_until(lambda: taken(0, small) or all(received.values()))
    pixels = np.full(size, 7, np.uint8)
    pixels[-1] = 9

    def arrives() -> bool:
        """Without `reliable`, a publication may be dropped rather than hold its publisher."""
        taken(1, pixels)
        with suppress(AssertionError):
            wait_until(lambda: all((1, size, 9) in i for i in received.values()), timeout=2.0)
            return True
        return False

    wait_until(arrives)
    wait_until(lambda: taken(2, small) or all(into[-1][0] == 2 for into in received.values()))
    for into in received.values():
        assert {entry[1:] for entry in into if entry[0] == 1} == {(size, 9)}, "none is torn"


@pytest.mark.needs("services", "between_processes")
@pytest.mark.parametrize("size", SIZES)
def test_query_carries_large_array_to_other_process(
    network: Network, start_peer: Callable[..., Peer], size: int
) -> None:
    start_peer("serve")
    probe = network.node("client").probe()
    probe.set_timeout(DEADLINE)
    sent = np.arange(size // 4, dtype=np.float32)
    assert np.array_equal(probe.echo(sent), sent)

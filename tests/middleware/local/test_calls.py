"""Calls over `local`: one connection for each calling thread."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from robocomp_dsl.runtime.errors import InterfaceMismatch, NoServer, Timeout
from robocomp_dsl.runtime.middleware.transport import ServerLost
from tests.middleware.local.direct import Side, open_descriptors
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import OTHER_PROBE, Broken
from tests.support.waiting import wait_until

Open = Callable[[str], Side]


def test_late_reply_is_not_taken_for_the_next_one(side: Open) -> None:
    late, server = threading.Event(), side("server")

    def echo(values: np.ndarray) -> np.ndarray:
        if values[0] == 1:
            late.wait(60)
        return values

    record = server.serve({"echo": echo})
    call = side("client").calls(record, timeout=0.1)
    with pytest.raises(Timeout, match=r"server.Probe.echo did not reply within 0\.1 s"):
        call("echo", np.float32([1]))
    call.client.set_timeout(60)
    late.set()
    for value in range(2, 50):
        assert call("echo", np.float32([value])) == [value]


def test_timeout_of_an_open_connection_can_be_changed(side: Open) -> None:
    free, server = threading.Event(), side("server")
    record = server.serve({"add": lambda a, b: a + b, "block": lambda: free.wait(60)})
    call = side("client").calls(record)
    assert call("add", 1, 2) == 3
    call.client.set_timeout(0.05)
    with pytest.raises(Timeout):
        call("block")
    free.set()


def test_cancel_ends_waiting_and_later_calls(side: Open) -> None:
    free, entered, server = threading.Event(), threading.Event(), side("server")

    def block() -> None:
        entered.set()
        free.wait(60)

    call = side("client").calls(server.serve({"block": block, **HANDLERS}))
    with ThreadPoolExecutor(1) as threads:
        waiting = threads.submit(call, "block")
        entered.wait(60)
        call.client.cancel()
        with pytest.raises(ServerLost, match="is stopping"):
            waiting.result(60)
    free.set()
    with pytest.raises(ServerLost):
        call("add", 1, 2)


def test_call_of_a_closed_server_is_lost(side: Open) -> None:
    server, client = side("server"), side("client")
    call, other = (client.calls(server.serve(HANDLERS)) for _ in range(2))
    assert call("add", 1, 2) == 3
    server.transport.close()
    for each in (call, other):
        with pytest.raises(ServerLost, match="the component that served it exited"):
            each("add", 1, 2)


def test_server_that_closes_finishes_the_running_call(side: Open) -> None:
    free, entered, server = threading.Event(), threading.Event(), side("server")

    def add(a: int, b: int) -> int:
        entered.set()
        free.wait(60)
        return a + b

    call = side("client").calls(server.serve({"add": add}))
    with ThreadPoolExecutor(1) as threads:
        waiting = threads.submit(call, "add", 1, 2)
        entered.wait(60)
        server.transport.close()
        free.set()
        assert waiting.result(60) == 3


def test_call_with_another_interface_is_a_mismatch(side: Open) -> None:
    record = side("server").serve(HANDLERS)
    call = side("client").calls(record, OTHER_PROBE)
    for _ in range(2):
        with pytest.raises(InterfaceMismatch, match=r"client\.Probe and server\.Probe"):
            call("add", 1, 2)


def test_command_to_another_interface_is_a_mismatch(side: Open) -> None:
    record = side("server").serve({"add": lambda a, b: a + b}, OTHER_PROBE)
    with pytest.raises(InterfaceMismatch):
        side("client").calls(record)("note", "x")


def test_invalid_addresses_are_lost_servers(side: Open) -> None:
    from dataclasses import replace  # noqa: PLC0415

    record = side("server").serve(HANDLERS)
    path = record.address.partition("#")[0]
    for address in ("", "#", "nothing", "/nothing#1", f"{path}#9", f"{path}#x", f"{'x' * 200}#1"):
        call = side("client").calls(replace(record, address=address))
        with pytest.raises(NoServer):
            call("add", 1, 2)


def test_calls_of_many_threads_get_their_own_replies(side: Open) -> None:
    call = side("client").calls(side("server").serve(HANDLERS))

    def work(thread: int) -> bool:
        values = np.arange(thread, thread + 1 + 997 * (thread % 7), dtype=np.float32)
        return all(
            call("add", thread, n) == thread + n and np.array_equal(call("echo", values), values)
            for n in range(30)
        )

    with ThreadPoolExecutor(16) as threads:
        assert all(threads.map(work, range(32)))


def test_connection_ends_with_its_thread(side: Open) -> None:
    server = side("server")
    call = side("client").calls(server.serve(HANDLERS))
    call("add", 1, 2)
    gc.collect()
    before = open_descriptors()
    for _ in range(20):
        thread = threading.Thread(target=call, args=("add", 1, 2))
        thread.start()
        thread.join()
    wait_until(lambda: open_descriptors() <= before)


def test_calls_leave_no_descriptors(side: Open) -> None:
    server = side("server")
    record, client = server.serve(HANDLERS), side("client")
    before = open_descriptors()
    for _ in range(20):
        call = client.calls(record)
        array = np.zeros(200_000, np.float32)
        assert call("echo", array).nbytes == array.nbytes
        call.client.close()
        del call
    wait_until(lambda: open_descriptors() <= before + 12)  # files of both pools


@pytest.mark.parametrize("megabytes", [0.05, 0.07, 1, 8, 64])
def test_query_carries_large_messages(side: Open, megabytes: float) -> None:
    call = side("client").calls(side("server").serve(HANDLERS))
    sent = np.arange(megabytes * 1e6 // 4, dtype=np.float32)
    received = call("echo", sent)
    assert np.array_equal(received, sent)
    assert not received.flags.writeable


def test_large_result_of_strings_and_failures_arrive(side: Open) -> None:
    from robocomp_dsl.runtime.errors import RemoteError  # noqa: PLC0415

    server = side("server")

    def fail() -> None:
        raise KeyError("x" * 200_000)

    call = side("client").calls(server.serve({"fail": fail}))
    with pytest.raises(RemoteError, match="xxxx"):
        call("fail")
    call("note", "y" * 300_000)


def test_commands_of_one_thread_stay_in_order_with_its_queries(side: Open) -> None:
    notes: list[str] = []
    server = side("server")
    record = server.serve({"note": notes.append, "add": lambda _a, _b: len(notes)})
    call = side("client").calls(record)
    for number in range(1, 200):
        call("note", "n" * (1 if number % 10 else 100_000))
        assert call("add", 0, 0) == number


def test_nested_calls_between_two_components_do_not_deadlock(side: Open) -> None:
    left, right = side("left"), side("right")
    call_left: list[object] = []

    def from_right(depth: int) -> int:
        return depth and waits(right, call_left[0], depth - 1) + 1

    def from_left(depth: int) -> int:
        return depth and waits(left, call_right, depth - 1) + 1

    def waits(caller: Side, call: Callable[..., int], depth: int) -> int:
        paused = caller.group.pause()
        try:
            return call("nested", depth)
        finally:
            caller.group.resume(paused)

    call_right = left.calls(right.serve({"nested": from_right}))
    call_left.append(right.calls(left.serve({"nested": from_left})))
    with left.group:
        assert waits(left, call_right, 12) == 12


def test_operation_that_is_not_served_is_a_mismatch(side: Open) -> None:
    call = side("client").calls(side("server").serve({"add": lambda a, b: a + b}))
    with pytest.raises(InterfaceMismatch, match="there is no such operation"):
        call("echo", np.zeros(1, np.float32))
    assert call("add", 1, 2) == 3


def test_long_declared_exception_arrives(side: Open) -> None:
    def divide(_a: int, _b: int) -> tuple[int, int]:
        raise Broken(5, "z" * 100_000)

    with pytest.raises(Broken) as caught:
        side("client").calls(side("server").serve({"divide": divide}))("divide", 1, 0)
    assert (caught.value.code, len(caught.value.what)) == (5, 100_000)

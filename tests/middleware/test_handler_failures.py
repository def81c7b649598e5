"""Failures as bytes of an error reply, and threads of a queue that die."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue

import pytest

from robocomp_dsl.runtime.codec.failures import decode_failure, encode_failure
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue, QueueClosed
from tests.middleware.probe_types import PROBE


def test_encode_failure_replaces_what_utf8_has_not() -> None:
    error = OSError("no file \udcff")
    data = encode_failure(PROBE.operation("fail"), error)
    assert str(decode_failure(PROBE.operation("fail"), "a.Probe", data, 1.0)) == (
        "a.Probe.fail failed: OSError: no file ?"
    )


@pytest.mark.parametrize("dying", ["take", "handle"])
def test_receiver_thread_death_ends_component_and_blocks_nobody(dying: str) -> None:
    jobs: SimpleQueue[str] = SimpleQueue()
    reasons: SimpleQueue[str] = SimpleQueue()

    def fault() -> None:
        raise SystemError("out of order")

    def take() -> str:
        job = jobs.get()
        if job == "take":
            fault()
        if job == "close":
            raise QueueClosed
        return job

    actions: dict[str, Callable[[], None]] = {"handle": fault}
    group = CallbackGroup()
    queue = LeaderFollowerQueue(
        "arm.Laser", take, lambda job: actions[job](), group, reasons.put, QueueClosed
    )
    jobs.put(dying)
    reason = reasons.get(timeout=30)
    assert "the thread arm.Laser died: SystemError: out of order" in reason
    assert queue.join(30)
    assert not [t for t in threading.enumerate() if t.name == "arm.Laser"]

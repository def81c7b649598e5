"""A running bridge: when outputs are sent, what is counted, and what the log says."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.bridge import values
from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.running import RunningBridge
from robocomp_dsl.runtime.bridge.spec import (
    BridgeSpec,
    HubSpec,
    InputSpec,
    OutputSpec,
    ServiceSpec,
)
from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.errors import EncodeError, NoServer, ReportedFailure


class SteppedClock:
    """A simulated clock that the test sets."""

    reset_count = 0
    is_stale = False

    def __init__(self) -> None:
        self.time = 10.0

    def now(self) -> float:
        return self.time

    def wait_until(self, moment: float | None, wake: Any) -> None:
        raise NotImplementedError


class Host:
    """What a bridge needs of its worker."""

    _lifecycle: Lifecycle

    def __init__(self) -> None:
        self.clock = SteppedClock()
        self.log = logging.getLogger("bridge")

    def mirror(self, numbers: list[float]) -> list[float]:
        return [-number for number in numbers]


def _sum(at: MessageContext, user: Host, inputs: tuple[float, ...]) -> tuple[Any, ...]:
    at.field = "total"
    return (sum(inputs), at.counter, at.now_ns)


def _bridge(
    output: OutputSpec | None = None, policy: Any = "latest", **hub: Any
) -> tuple[RunningBridge, Host, list[tuple[Any, ...]]]:
    host, sent = Host(), []
    inputs = tuple(
        InputSpec(name, name, "receive", f"x.bdsl:{line}", needs_stamp=True)
        for line, name in enumerate("ab", 1)
    )
    hubs = (HubSpec("h", ("a", "b"), "x.bdsl:3", policy, **hub),)
    output = output or OutputSpec("out", "out", "send", ("h",), _sum, {"": "x.bdsl:4"})

    def publish(*arguments: Any) -> None:
        sent.append(arguments)

    spec = BridgeSpec("x.bdsl", inputs, hubs, (output,))
    stamp = lambda: round(host.clock.time * 1e9)  # noqa: E731
    return RunningBridge(spec, host, {"out": publish}, Statistics(), stamp), host, sent


def test_bridge_sends_output_with_each_message_after_first_set() -> None:
    bridge, _, sent = _bridge()
    bridge.inputs["a"].receive(1)
    assert sent == []
    bridge.inputs["b"].receive(10)
    bridge.inputs["b"].receive(20)
    assert sent == [(11, 0, 10_000_000_000), (21, 1, 10_000_000_000)]
    assert bridge.outputs["out"].counts.messages == 2
    assert bridge.inputs["b"].counts.messages == 2
    assert bridge.outputs["out"].counts.latencies == 2


def test_bridge_sends_output_with_rate_on_component_clock() -> None:
    output = OutputSpec("out", "out", "send", ("h",), _sum, rate=10.0)
    bridge, host, sent = _bridge(output)
    bridge.inputs["a"].receive(1)
    bridge.send_due()
    assert sent == []
    bridge.inputs["b"].receive(10)
    assert sent == []
    for _ in range(10):
        host.clock.time += 0.1
        bridge.send_due()
    assert [message[:2] for message in sent] == [(11, count) for count in range(10)]
    assert sent[-1][2] == 11_000_000_000


def test_bridge_with_rate_and_policy_all_sends_each_set_once() -> None:
    output = OutputSpec("out", "out", "send", ("h",), _sum, rate=10.0)
    bridge, host, sent = _bridge(output, policy="all")
    for number in range(3):
        bridge.inputs["a"].receive(number)
        bridge.inputs["b"].receive(number)
        for _ in range(5):
            host.clock.time += 0.1
            bridge.send_due()
    assert [message[0] for message in sent] == [0, 2, 4]


@pytest.mark.parametrize(("policy", "count"), [("latest", 3), ("all", 1), ("synchronised", 3)])
def test_bridge_output_of_hub_and_input_waits_for_new_set_of_policy_all(
    policy: Any, count: int
) -> None:
    host, sent = Host(), []
    inputs = tuple(InputSpec(name, name, "receive", "") for name in "abc")
    hubs = (HubSpec("h", ("a", "b"), "", policy), HubSpec("c", ("c",), ""))
    output = OutputSpec("out", "out", "send", ("h", "c"), lambda *_: (1,))
    spec = BridgeSpec("x.bdsl", inputs, hubs, (output,))
    bridge = RunningBridge(spec, host, {"out": sent.append}, Statistics())
    for name in "abccc":
        bridge.inputs[name].receive(1)
    assert len(sent) == count


def test_bridge_rate_changes_at_run_time() -> None:
    bridge, host, sent = _bridge()
    assert bridge.set_rate("out", 4.0) == 250.0
    bridge.inputs["a"].receive(1)
    bridge.inputs["b"].receive(10)
    assert sent == []
    host.clock.time += 0.25
    bridge.send_due()
    assert len(sent) == 1
    assert bridge.set_rate("out", 0.0) == 0.0
    bridge.inputs["b"].receive(10)
    assert len(sent) == 2


def test_bridge_does_not_send_messages_older_than_max_age(
    caplog: pytest.LogCaptureFixture,
) -> None:
    output = OutputSpec("out", "out", "send", ("h",), _sum, rate=10.0)
    bridge, host, sent = _bridge(output, max_age=0.5)
    bridge.inputs["a"].receive(1)
    host.clock.time += 0.4
    bridge.inputs["b"].receive(10)
    bridge.send_due()
    assert len(sent) == 1
    for _ in range(5):
        host.clock.time += 0.2
        bridge.send_due()
    assert len(sent) == 1
    assert bridge.outputs["out"].counts.dropped == {"older than max_age": 5}
    text = "output `out`: not sent: the newest message of `a` is 0.6 s old, max_age of `h` is 0.5 s"
    assert [record.getMessage() for record in caplog.records] == [f"{text} (x.bdsl:3)"]
    bridge.set_max_age("h", 0.0)
    host.clock.time += 0.2
    bridge.send_due()
    assert len(sent) == 2


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (lambda: values.element([], 0), "total: there is no item 0: the sequence has 0 (x.bdsl:5)"),
        (
            lambda: _raise(EncodeError("300 does not fit", "message.position[3]")),
            "position[3]: 300 does not fit (x.bdsl:6)",
        ),
        (
            lambda: _raise(EncodeError("300 does not fit", "message.effort")),
            "effort: 300 does not fit (x.bdsl:4)",
        ),
        (lambda: _raise(NoServer("nobody")), "nobody (x.bdsl:4)"),
        (lambda: 1 / 0, "total: ZeroDivisionError: division by zero"),
    ],
)
def test_bridge_reports_message_that_cannot_be_sent_and_continues(
    error: Any, text: str, caplog: pytest.LogCaptureFixture
) -> None:
    broken = [True]

    def build(at: MessageContext, user: Host, inputs: tuple[float, ...]) -> tuple[Any, ...]:
        at.field = "total"
        if broken:
            error()
        return (sum(inputs),)

    places = {"": "x.bdsl:4", "total": "x.bdsl:5", "position": "x.bdsl:6"}
    bridge, _, sent = _bridge(OutputSpec("out", "out", "send", ("h",), build, places))
    bridge.inputs["a"].receive(1)
    for _ in range(3):
        bridge.inputs["b"].receive(10)
    assert sent == []
    assert bridge.outputs["out"].counts.dropped.total() == 3
    (record,) = caplog.records
    assert record.getMessage().startswith(f"output `out`: not sent: {text}")
    assert bridge._statistics.of("out", "send").failures == 3
    broken.clear()
    bridge.inputs["b"].receive(10)
    assert sent == [(11,)]


def _raise(error: Exception) -> None:
    raise error


def test_bridge_counts_drops_of_hub_at_its_input(caplog: pytest.LogCaptureFixture) -> None:
    bridge, _, _ = _bridge(policy="all")
    for number in range(15):
        bridge.inputs["a"].receive(number)
    assert bridge.inputs["a"].counts.dropped.total() == 5
    assert bridge._statistics.of("a", "receive").drops == 5
    assert len(caplog.records) == 1
    assert "hub `h`" in caplog.text
    assert "input `a`: 15 received, 5 dropped" in "\n".join(bridge.summary())


def test_bridge_tolerance_changes_at_run_time() -> None:
    bridge, host, sent = _bridge(policy="synchronised", tolerance=0.01)
    bridge.inputs["a"].receive(1)
    host.clock.time += 0.05
    bridge.inputs["b"].receive(10)
    assert sent == []
    bridge.set_tolerance("h", 0.1)
    bridge.inputs["a"].receive(2)
    assert len(sent) == 1


def test_bridge_input_check_rejects_message(caplog: pytest.LogCaptureFixture) -> None:
    host = Host()
    spec = BridgeSpec(
        "x.bdsl",
        (InputSpec("a", "a", "receive", "x.bdsl:1", check=lambda m: values.with_length(m, 2, 2)),),
        (HubSpec("a", ("a",), "x.bdsl:1"),),
        (OutputSpec("out", "out", "send", ("a",), lambda _at, _user, messages: messages),),
    )
    sent: list[Any] = []
    bridge = RunningBridge(spec, host, {"out": sent.append}, Statistics())
    bridge.inputs["a"].receive(np.zeros(3))
    assert sent == []
    assert "input `a`: dropped: takes 2 items, not 3 (x.bdsl:1)" in caplog.text
    bridge.inputs["a"].receive(np.ones(2))
    assert len(sent) == 1


def test_bridge_service_passes_failure_on_and_counts_it(caplog: pytest.LogCaptureFixture) -> None:
    def answer(at: MessageContext, user: Host, number: float) -> float:
        at.field = "motors.on"
        return 1 / number

    spec = BridgeSpec("x.bdsl", services=(ServiceSpec("s", "s", "call", answer, {"": "x.bdsl:9"}),))
    bridge = RunningBridge(spec, Host(), {}, Statistics())
    assert bridge.services["s"].answer(2.0) == 0.5
    with pytest.raises(ReportedFailure, match=r"division by zero .*\(x.bdsl:9\)"):
        bridge.services["s"].answer(0.0)
    assert "service `s`: failed: motors.on: ZeroDivisionError" in caplog.text
    assert bridge.services["s"].counts.messages == 2
    assert bridge.services["s"].counts.dropped.total() == 1

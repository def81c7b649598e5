"""Monitors that cannot be loaded, and monitors whose hooks fail."""

from __future__ import annotations

import logging
from typing import Any

import pytest

from robocomp_dsl.runtime.errors import CallRejected, MonitorError
from tests.monitors.components import HEADER, Caller, Deployment, Server, Speaker

FAILING = """
    class Failing(Monitor):
        def __init__(self, hook: str = "") -> None:
            self.hook = hook
            self._check("__init__")

        def _check(self, hook: str) -> None:
            if hook == self.hook:
                raise KeyError(hook)

        def on_create(self) -> None:
            self._check("on_create")

        def accept(self, operation, arguments):
            self._check("accept")
            return 1 if self.hook == "answer" else True

        def update_add(self, a: int, b: int):
            self._check("update_add")
            return {"value": (a, "b"), "count": (a, b, 3), "type": 5}.get(self.hook, (a, b))

        def on_destroy(self) -> None:
            self._check("on_destroy")
    """


def call(deployment: Deployment, policy: str, hook: str, times: int = 3) -> list[Any]:
    """The results of calls over a connection whose monitor fails in a hook."""
    deployment.write(FAILING)
    monitor = deployment.monitor("Failing", policy, hook=hook)
    entry = {"port": "Probe", "at": "sender", "peer": "server.Probe", "monitors": [monitor]}
    deployment.start(Server, "server")
    proxy = deployment.start(Caller, "caller", [entry], peers=("server",)).worker.probe_proxy
    assert proxy.wait_for_server(60)
    results: list[Any] = []
    for number in range(times):
        try:
            results.append(proxy.add(number, 1))
        except CallRejected as error:
            results.append(str(error))
    return results


@pytest.mark.parametrize(
    ("hook", "message", "line"),
    [
        ("__init__", "__init__ failed: KeyError: '__init__'", "raise KeyError"),
        ("on_create", "on_create failed: KeyError: 'on_create'", "raise KeyError"),
        ("accept", "accept failed: KeyError: 'accept'", "raise KeyError"),
        ("answer", "accept returned 1 (int), not True or False", "def accept("),
        ("update_add", "update_add failed: KeyError: 'update_add'", "raise KeyError"),
        ("value", "returned a wrong value: b: takes an integer (int), not 'b'", "def update_add"),
        ("count", "returned a wrong value: add has the arguments (a, b), not 3", "def update_add"),
        ("type", "update_add returned 5 (int), not a tuple of arguments", "def update_add"),
    ],
)
@pytest.mark.parametrize("policy", ["bypass", "close"])
def test_monitor_failure_is_reported_once_and_treated_as_declared(
    quick_deployment: Deployment,
    caplog: pytest.LogCaptureFixture,
    policy: str,
    hook: str,
    message: str,
    line: str,
) -> None:
    results = call(quick_deployment, policy, hook)
    if policy == "bypass":
        assert results == [1, 2, 3]
    else:
        assert [str(r).rpartition(": ")[2] for r in results] == [
            "the connection is closed since a monitor failed"
        ] * 3
    (record,) = [r for r in caplog.records if r.levelno >= logging.ERROR]
    text = record.getMessage()
    assert text.startswith("monitor Failing of caller.Probe -> server.Probe: ")
    assert message in text
    number = int(text.partition(f"{quick_deployment.file}:")[2].partition(")")[0])
    assert line in quick_deployment.file.read_text().splitlines()[number - 1]


def test_monitor_that_fails_in_on_destroy_is_reported(
    quick_deployment: Deployment, caplog: pytest.LogCaptureFixture
) -> None:
    assert call(quick_deployment, "close", "on_destroy") == [1, 2, 3]
    quick_deployment.close()
    assert "on_destroy failed: KeyError" in caplog.text


def test_monitor_states_tell_what_failed(quick_deployment: Deployment) -> None:
    quick_deployment.write(FAILING)
    states = {}
    for policy in ("bypass", "close"):
        monitor = quick_deployment.monitor("Failing", policy, hook="on_create")
        entry = {"port": "Probe", "at": "sender", "peer": "a.Probe", "monitors": [monitor]}
        caller = quick_deployment.start(Caller, policy, [entry])
        (status,) = caller.monitors.statuses()
        states[policy] = (status.state, status.failures)
    assert states == {"bypass": ("bypassed", 1), "close": ("closed", 1)}


@pytest.mark.parametrize(
    ("text", "name", "parameters", "message"),
    [
        (None, "Limit", {}, "cannot read the monitor"),
        ("class Limit(Monitor:", "Limit", {}, "monitors.py:2:"),
        (
            "class Limits(Monitor): pass",
            "Limit",
            {},
            "has no class `Limit`; did you mean `Limits`?",
        ),
        ("class Limit: pass", "Limit", {}, "monitors.py:2:7: class `Limit` does not extend"),
        ("class Limit(Monitor): pass", "Limit", {"max": 3}, "`Limit` has no parameter `max`"),
        ("import nowhere\nclass Limit(Monitor): pass", "Limit", {}, "monitors.py:2)"),
        ("1 / 0\nclass Limit(Monitor): pass", "Limit", {}, "ZeroDivisionError"),
        ("from os import PathLike as B\nclass Limit(B): pass", "Limit", {}, "does not extend"),
        (
            "class Limit(Monitor):\n    def accept_anounced(self, who, n): return True",
            "Limit",
            {},
            "monitors.py:3:9: the interface has no operation `anounced`; did you mean"
            " `accept_announced`?",
        ),
    ],
)
def test_monitor_that_cannot_be_loaded_is_located(
    quick_deployment: Deployment,
    text: str | None,
    name: str,
    parameters: dict[str, object],
    message: str,
) -> None:
    if text is not None:
        quick_deployment.file.write_text(HEADER + text)
    monitor = quick_deployment.monitor(name, **parameters)
    entry = {"port": "News", "at": "sender", "peer": "a.News", "monitors": [monitor]}
    with pytest.raises(MonitorError) as caught:
        quick_deployment.start(Speaker, "speaker", [entry])
    assert message in str(caught.value)
    assert str(quick_deployment.file) in str(caught.value)


@pytest.mark.parametrize(
    ("position", "port"), [("receiver", "News"), ("sender", "Probe"), ("identify", "News")]
)
def test_monitor_of_a_port_at_the_wrong_end_is_rejected(
    quick_deployment: Deployment, position: str, port: str
) -> None:
    entry = {"port": port, "at": position, "peer": "a.News"}
    with pytest.raises(MonitorError, match=f"no port `{port}` that is the {position}"):
        quick_deployment.start(Speaker, "speaker", [entry])


def test_component_without_monitors_has_the_same_ports(quick_deployment: Deployment) -> None:
    speaker = quick_deployment.start(Speaker, "speaker")
    assert speaker._ports is speaker._clock_binding.ports
    assert speaker.monitors is None

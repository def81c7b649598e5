"""Deprecated names of the runtime still work, and warn."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime import parameters
from robocomp_dsl.runtime.clock import WallClock
from robocomp_dsl.runtime.component.component_interface import ComponentProxy
from robocomp_dsl.runtime.component.proxy import Proxy
from robocomp_dsl.runtime.machine import Machine


def test_deprecated_refused_is_parameter_rejected() -> None:
    with pytest.deprecated_call(match="ParameterRejected"):
        assert parameters.Refused is parameters.ParameterRejected


def test_deprecated_clock_names_return_the_new_values() -> None:
    clock = WallClock()
    with pytest.deprecated_call(match="reset_count"):
        assert clock.epoch == clock.reset_count
    with pytest.deprecated_call(match="is_stale"):
        assert clock.silent is clock.is_stale


def test_deprecated_proxy_is_heard_calls_has_subscribers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Proxy, "has_subscribers", lambda _: True)
    proxy = ComponentProxy.__new__(ComponentProxy)
    with pytest.deprecated_call(match="has_subscribers"):
        assert proxy.is_heard()


def test_deprecated_machine_go_calls_send(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[tuple[str, dict[str, object]]] = []

    def send(_: Machine, event: str, **data: object) -> bool:
        sent.append((event, data))
        return True

    monkeypatch.setattr(Machine, "send", send)
    machine = Machine.__new__(Machine)
    with pytest.deprecated_call(match="machine.send"):
        assert machine.go("start", speed=2)
    assert sent == [("start", {"speed": 2})]

"""Quality of service as text."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.qos_settings import (
    change_items,
    format_qos,
    parse_items,
    parse_qos,
)
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.qos_merge import connection_qos, sender_qos
from robocomp_dsl.runtime.connection.qos_support import UnsupportedQos, check_qos
from tests.middleware.probe_types import NEWS, PROBE

ALL = Qos(True, 3, "high", 0.04, True, True, 0.5, 80)


@pytest.mark.parametrize(
    "text",
    [
        "laser",
        "laser=fast",
        "laser=depth=0",
        "laser=depth=x",
        "laser=priority=urgent",
        "laser=deadline=nan",
        "laser=liveliness=-1",
        "laser=thread_priority=100",
        "laser=keep_all,best_effort",
        "laser/=reliable",
        "=reliable",
    ],
)
def test_parse_qos_rejects_invalid_text(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_qos([text])


def test_parse_qos_reads_settings() -> None:
    texts = ["laser=best_effort,depth=1", "laser=priority=high,deadline=40", "laser//a/b.X=latched"]
    ports, peers = parse_qos(texts)
    assert ports == {"laser": Qos(False, 1, "high", 0.04)}
    assert peers == {"laser": {"/a/b.X": Qos(latched=True)}}
    _, external = parse_qos(["Laser/front@ice:laser:tcp -h 10.0.0.2 -p 10001=depth=2"])
    assert external == {"Laser": {"/front": Qos(depth=2)}}


def test_format_qos_is_the_inverse_of_parse_items() -> None:
    assert parse_items(format_qos(ALL), Qos()) == ALL
    assert format_qos(Qos(reliable=False)) == "best_effort"
    assert format_qos(Qos()) == ""


def test_change_items_sets_and_removes_items() -> None:
    assert change_items("depth=5,deadline=off,priority=low", ALL) == Qos(
        True, 5, "low", None, True, True, 0.5, 80
    )
    assert change_items("best_effort", ALL).keep_all is None
    with pytest.raises(InvalidSetting):
        change_items("depht=off", ALL)


def test_connection_qos_overrides_that_of_the_port() -> None:
    settings = RunSettings(
        prefix="left",
        peer_qos={"News": {"a": Qos(depth=2), "a.News": Qos(priority="high"), "/b": Qos(depth=9)}},
    )
    items = settings.connection_qos("News")
    at = Endpoint(NEWS, "left/s", "News", (), Qos(True, depth=1), (), (), items)
    assert connection_qos(at, "left/a.News") == Qos(True, 2, "high")
    assert connection_qos(at, "left/a.Other") == Qos(True, 2)
    assert connection_qos(at, "b.News") == Qos(True, 9)
    assert connection_qos(at, "other.News") == Qos(True, 1)
    assert sender_qos(at) == Qos(True, 9, "high")


def endpoint_of(qos: Qos, **peer_qos: Qos) -> Endpoint:
    return Endpoint(PROBE, "base", "Probe", qos=qos, peer_qos=tuple(peer_qos.items()))


def test_check_qos_needs_one_middleware_for_a_connection_and_all_for_a_port() -> None:
    high = Qos(priority="high")
    check_qos(endpoint_of(Qos(), eye=high), "server", iter(("local", "zenoh")))
    check_qos(endpoint_of(high), "server", ("zenoh",))
    with pytest.raises(UnsupportedQos, match="the middleware `local` cannot do"):
        check_qos(endpoint_of(high), "server", ("zenoh", "local"))
    with pytest.raises(UnsupportedQos, match="the middleware `local` cannot do"):
        check_qos(endpoint_of(Qos(), eye=high), "server", ("local",))

"""Whole components under prefixes, as `main` runs them: two copies of a set in one domain."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator

import pytest

from robocomp_dsl.runtime import CalledPort, Component, ComponentSpec, ServedPort
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.parameters import Parameters
from tests.middleware.network import DEADLINE
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy, ProbeProxy
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Namespaces"), pytest.mark.needs("services", "topics")]


class Base(Component):
    SPEC = ComponentSpec(
        name="base",
        period=2,
        implements=(ServedPort("Probe", PROBE, {"echo": "echo", "add": "add"}),),
        publishes=(CalledPort("News", NewsProxy, "news"),),
    )
    news: NewsProxy
    offset = 0

    def add(self, a: int, b: int) -> int:
        return a + b + self.offset

    def echo(self, v: object) -> object:
        return v

    def compute(self) -> None:
        self.news.announced(self.name, 0)


class Arm(Component):
    SPEC = ComponentSpec(
        name="arm",
        period=0,
        requires=(CalledPort("Probe", ProbeProxy, "probe"),),
        subscribes=(ServedPort("News", NEWS, {"announced": "received"}),),
    )
    probe: ProbeProxy

    def __init__(self) -> None:
        self.publishers: set[str] = set()

    def received(self, who: str, _n: int) -> None:
        self.publishers.add(who)


Start = Callable[..., Component]


@pytest.fixture
def domain() -> str:
    return f"test-{uuid.uuid4().hex[:12]}"


@pytest.fixture
def start(middleware: str, domain: str) -> Iterator[Start]:
    running: list[Runner] = []

    def begin(kind: type[Component], **settings: object) -> Component:
        run_settings = RunSettings(domain=domain, middleware=middleware, **settings)  # type: ignore[arg-type]
        running.append(Runner(kind, Parameters.load(), run_settings))
        running[-1].start()
        return running[-1].worker

    yield begin
    for runner in running:
        runner.stop()
    for runner in running:
        runner.wait()


def test_prefixed_copies_of_components_are_independent(start: Start) -> None:
    arms = {}
    for prefix, offset in (("left", 100), ("right", 200)):
        base = start(Base, prefix=prefix)
        assert isinstance(base, Base)
        base.offset = offset
        arms[prefix] = start(Arm, prefix=prefix)
    for prefix, offset in (("left", 100), ("right", 200)):
        arm = arms[prefix]
        assert isinstance(arm, Arm)
        assert arm.name == f"{prefix}/arm"
        assert arm.probe.add(1, 2) == offset + 3
        wait_until(lambda arm=arm: arm.publishers)
        assert arm.publishers == {f"{prefix}/base"}


def test_prefix_applies_to_connection(start: Start) -> None:
    for name, offset in (("first", 1), ("second", 2)):
        base = start(Base, prefix="left", name=name)
        assert isinstance(base, Base)
        base.offset = offset
    arm = start(Arm, prefix="left", connections={"Probe": ("second",), "News": ("/left/first",)})
    assert isinstance(arm, Arm)
    assert arm.probe.add(0, 0) == 2
    wait_until(lambda: arm.publishers)
    assert arm.publishers == {"left/first"}


def test_prefixed_ports_may_have_other_names(start: Start) -> None:
    for name, front in (("a", "Probe"), ("b", "front")):
        base = start(Base, name=name, remaps={"Probe": front, "News": f"{front}-news"})
        assert isinstance(base, Base)
        base.offset = ord(name)
    arm = start(Arm, remaps={"Probe": "front", "News": "front-news"})
    assert isinstance(arm, Arm)
    assert arm.probe.add(0, 0) == ord("b")
    wait_until(lambda: arm.publishers)
    assert arm.publishers == {"b"}


def test_introspection_reports_prefixed_names(start: Start, middleware: str, domain: str) -> None:
    start(Base, prefix="left", remaps={"Probe": "front"})
    start(Arm, prefix="left", connections={"Probe": ("base",)}, remaps={"Probe": "front"})
    looker = open_ports(
        middleware, ComponentContext("looker", domain, CallbackGroup(), Statistics())
    )
    try:
        infos = {}
        for name in ("left/base", "left/arm"):
            about = ComponentProxy(
                looker.proxy(Endpoint(COMPONENT, "looker", "Component", (name,)))
            )
            assert about.wait_for_server(DEADLINE)
            infos[name] = about.getInfo()
    finally:
        looker.close()
    assert [info.name for info in infos.values()] == ["left/base", "left/arm"]
    ports = {p.name: list(p.peers) for info in infos.values() for p in info.ports}
    assert ports == {"front": [], "News": [], "Probe": ["left/base.front"]}

"""Programs with the certificate of a component that do what its description does not declare.

The router keeps each of them out, and says so. They use this project's own runtime, changed only in
what they ask for; `intruder` has the certificate of `boss`, and `operator` may do everything, so
that only the router can have kept a message out.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from robocomp_dsl.runtime.client import load_generated_interfaces
from robocomp_dsl.runtime.component.component_interface import COMPONENT
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.network_settings import domain_settings_path
from tests.deploy.network.network_node import NetworkNode, open_node
from tests.deploy.network.secured_deployment import SecuredDeployment
from tests.deploy.rcdeploy_process import RunningProcess, runtime_folder
from tests.support.waiting import wait_until


class Stage:
    """A running router, a program with the certificate of `boss`, and one of the operator."""

    def __init__(
        self, site: SecuredDeployment, folder: Path, router: RunningProcess, stack: ExitStack
    ) -> None:
        self.site = site
        self.router = router
        self.interfaces = load_generated_interfaces(folder / "boss")
        self._stack = stack
        self._patch = pytest.MonkeyPatch()

    def intruder(self, name: str = "boss") -> NetworkNode:
        """A program with the certificate of `boss` that says it is `name`."""
        settings = self.site.settings_file("boss")
        return self._stack.enter_context(open_node(settings, name, self.site.domain, self._patch))

    def operator(self, name: str) -> NetworkNode:
        settings = domain_settings_path(self.site.domain)
        return self._stack.enter_context(open_node(settings, name, self.site.domain, self._patch))


@pytest.fixture(scope="module")
def running(
    components: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[SecuredDeployment, RunningProcess]]:
    """The deployment with the router of `left`; both last as long as the module."""
    folder = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch, runtime_folder(patch):
        patch.setenv("XDG_CONFIG_HOME", str(folder / "config"))
        patch.setenv("XDG_STATE_HOME", str(folder / "state"))
        site = SecuredDeployment(components)
        with site.start_router(site.hosts[0]) as router:
            yield site, router


@pytest.fixture
def stage(running: tuple[SecuredDeployment, RunningProcess], components: Path) -> Iterator[Stage]:
    with ExitStack() as stack:
        yield Stage(running[0], components, running[1], stack)


def test_router_keeps_out_undeclared_publication(stage: Stage) -> None:
    interface = stage.interfaces.NEWS
    received = stage.operator("listener").subscribe(interface, "News")
    publish = stage.intruder().publisher(interface, "News")
    allowed = stage.operator("worker").publisher(interface, "News")
    at = f"{keys.domain_prefix(stage.site.domain)}/t/Tasks::News/{interface.hash.hex()}"
    raw = stage.intruder("boss")
    raw.session.put(f"{at}/boss/News/news", b"raw")
    publish("forged")
    stage.router.until("denied: boss publishes boss.News news (Tasks::News)")

    def arrives() -> bool:
        allowed("allowed")
        return bool(received)

    wait_until(arrives)
    assert set(received) == {"allowed"}


def test_router_keeps_out_publication_in_the_name_of_another(stage: Stage) -> None:
    interface = stage.interfaces.NEWS
    received = stage.operator("listener").subscribe(interface, "News", "worker.News")
    at = f"{keys.domain_prefix(stage.site.domain)}/t/Tasks::News/{interface.hash.hex()}"
    stage.intruder().session.put(f"{at}/worker/News/news", b"forged")
    stage.router.until("denied: boss publishes worker.News news (Tasks::News)")
    allowed = stage.operator("worker").publisher(interface, "News")

    def arrives() -> bool:
        allowed("allowed")
        return bool(received)

    wait_until(arrives)
    assert set(received) == {"allowed"}


def test_router_keeps_out_undeclared_server(stage: Stage) -> None:
    calls: list[int] = []
    interface = stage.interfaces.JOB
    stage.intruder("worker").serve(interface, "Job", {"twice": calls.append})
    stage.router.until("denied: boss serves worker.Job (Tasks::Job)")
    operations = stage.operator("client").operations(interface, "worker.Job")
    with pytest.raises(NoServer):
        operations["twice"](4)
    stage.operator("worker").serve(interface, "Job", {"twice": lambda x: 2 * x})
    assert wait_until(lambda: operations["twice"](4), ignoring=MiddlewareError) == 8
    assert calls == []


def test_router_keeps_out_undeclared_call(stage: Stage) -> None:
    calls: list[object] = []
    stage.operator("worker").serve(COMPONENT, "Component", {"setParameters": calls.append})
    intruder = stage.intruder()
    operations = intruder.operations(COMPONENT, "worker.Component")
    with pytest.raises(NoServer, match="or its router denied the call"):
        operations["setParameters"]({"gain": "9"})
    text = "denied: boss calls worker.Component setParameters (RoboCompComponent::Component)"
    stage.router.until(text)
    assert calls == []
    stage.operator("other").operations(COMPONENT, "worker.Component")["setParameters"]({})
    assert len(calls) == 1


def test_router_keeps_out_undeclared_command(stage: Stage) -> None:
    stops: list[str] = []
    interface = stage.interfaces.JOB
    stage.operator("other").serve(interface, "Job", {"start": stops.append})
    intruder = stage.intruder()
    wait_until(lambda: intruder.ports.presence.registry.find("server", interface.name))
    key = f"{keys.domain_prefix(stage.site.domain)}/c/Tasks::Job/{interface.hash.hex()}"
    intruder.session.put(f"{key}/other/Job/start", b"forged")
    stage.router.until("denied: boss sends commands to other.Job start (Tasks::Job)")
    stage.operator("client").operations(interface, "other.Job")["start"]("dig")
    wait_until(lambda: stops)
    assert stops == ["dig"]


def test_router_keeps_out_undeclared_subscriber(stage: Stage) -> None:
    interface = stage.interfaces.NEWS
    received = stage.intruder().subscribe(interface, "News", "other.News")
    stage.router.until("denied: boss subscribes to other.News (Tasks::News)")
    publish = stage.operator("other").publisher(interface, "News")
    allowed = stage.operator("listener").subscribe(interface, "News", "other.News")

    def arrives() -> bool:
        publish("secret")
        return bool(allowed)

    wait_until(arrives)
    assert received == []


def test_component_with_certificate_of_another_is_not_seen(stage: Stage) -> None:
    """A wrong component name: its settings name the certificate of `boss`."""
    stage.intruder("worker").publisher(stage.interfaces.STATE, "State")
    stage.router.until("denied: boss publishes worker.State (Tasks::State)")
    operator = stage.operator("other")
    operator.publisher(stage.interfaces.STATE, "State")
    registry = operator.ports.presence.registry
    wait_until(lambda: registry.find("publisher", "Tasks::State"))
    assert {r.component for r in registry.find("publisher", "Tasks::State")} == {"other"}

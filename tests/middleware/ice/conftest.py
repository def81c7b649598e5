"""The interface Store: as Slice for plain programs, and as a generated package for components."""

from __future__ import annotations

import importlib
import sys
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from click.testing import CliRunner

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.ice.peers import STORE, PlainProgram, load_slice

_NAME = "ice_store_package"


@pytest.fixture(scope="session")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the Slice files of `rcgen interface --to slice`."""
    from robocomp_dsl.cli.rcgen.main import program  # noqa: PLC0415

    folder = tmp_path_factory.mktemp("slice")
    arguments = ["interface", str(STORE / "Store.idsl"), "--to", "slice", "-o", str(folder)]
    result = CliRunner().invoke(program, arguments)
    assert result.exit_code == 0, result.output
    return folder


@pytest.fixture(scope="session")
def slices(exported: Path) -> SimpleNamespace:
    """The modules of the Slice files as plain programs use them."""
    store, faults = load_slice(exported / "Store.ice", "RoboCompStore", "RoboCompFaults")
    return SimpleNamespace(store=store, faults=faults)


@pytest.fixture(scope="session")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The module `interfaces` of the generated package."""
    from robocomp_dsl.cli.rcgen.main import program  # noqa: PLC0415

    folder = tmp_path_factory.mktemp("store")
    for file in STORE.iterdir():
        (folder / file.name).write_text(file.read_text())
    result = CliRunner().invoke(program, ["component", str(folder / "store.cdsl")])
    assert result.exit_code == 0, result.output
    (folder / "store_generated").rename(folder / _NAME)
    sys.path.insert(0, str(folder))
    try:
        return importlib.import_module(f"{_NAME}.interfaces")
    finally:
        sys.path.remove(str(folder))


class IceComponent:
    """One component of ours whose ports are on Ice."""

    def __init__(self, name: str, domain: str, **options: Any) -> None:
        self.name = name
        self.statistics = Statistics()
        self.group = CallbackGroup()
        self.context = ComponentContext(name, domain, self.group, self.statistics, **options)
        self.ports: ComponentPorts = open_ports("ice", self.context)

    def endpoint(self, interface: Any, *external: str, qos: Qos | None = None) -> Endpoint:
        """The port of an interface; `external` are addresses of plain programs."""
        port = interface.name.rpartition("::")[2]
        records = tuple(
            PortRecord("server", interface.name, "plain", port, "", "ice", address)
            for address in external
        )
        middlewares = ("ice",)
        return Endpoint(interface, self.name, port, (), qos or Qos(), middlewares, records)

    def serve(self, interface: Any, handlers: dict[str, Callable[..., Any]]) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(self.endpoint(interface), every, self.group)

    def subscribe(
        self, interface: Any, handler: Callable[..., Any], *external: str, **options: Any
    ) -> None:
        handlers = {operation.name: handler for operation in interface.operations}
        self.ports.subscribe(self.endpoint(interface, *external, **options), handlers, self.group)


@pytest.fixture
def domain() -> str:
    return f"test-{uuid.uuid4().hex[:12]}"


@pytest.fixture
def component(domain: str) -> Iterator[Callable[..., IceComponent]]:
    """Opens components; they end with the test."""
    opened: list[IceComponent] = []

    def open_component(name: str = "own", **options: Any) -> IceComponent:
        opened.append(IceComponent(name, domain, **options))
        return opened[-1]

    yield open_component
    for each in opened:
        each.ports.close()


@pytest.fixture
def plain() -> Iterator[Callable[..., PlainProgram]]:
    """Starts plain programs within this process; they end with the test."""
    opened: list[PlainProgram] = []

    def open_program(**options: Any) -> PlainProgram:
        opened.append(PlainProgram(**options))
        return opened[-1]

    yield open_program
    for each in opened:
        each.close()

"""The interface Store: as Slice for plain programs, and as a generated package for components."""

from __future__ import annotations

import importlib
import sys
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from click.testing import CliRunner

from tests.middleware.ice.ice_component import IceComponent

if TYPE_CHECKING:
    from tests.middleware.ice.peers import PlainProgram

STORE = Path(__file__).parent / "store"
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
    from tests.middleware.ice.peers import load_slice  # noqa: PLC0415 - needs Ice

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
    from tests.middleware.ice.peers import PlainProgram  # noqa: PLC0415 - needs Ice

    opened: list[PlainProgram] = []

    def open_program(**options: Any) -> PlainProgram:
        opened.append(PlainProgram(**options))
        return opened[-1]

    yield open_program
    for each in opened:
        each.close()


@pytest.fixture
def connect(
    component: Callable[..., IceComponent], generated: Any
) -> Callable[[str], SimpleNamespace]:
    """A component whose port Store is connected to an address."""

    def connected(address: str) -> SimpleNamespace:
        own = component()
        channel = own.ports.proxy(own.endpoint(generated.STORE, address))
        return SimpleNamespace(proxy=generated.StoreProxy(channel), component=own)

    return connected

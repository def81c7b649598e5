"""Models of the shared cases and of texts, for the tests of models."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl, check_ddsl, check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Module, Operation

CASES = Path(__file__).parent.parent / "cases"


def case_workspace() -> Workspace:
    """A workspace with the interfaces of the cases."""
    return Workspace(environ={}, shipped=CASES / "interfaces")


def module_of(text: str, tmp_path: Path) -> Module:
    """The module of an IDSL text without errors."""
    path = tmp_path / "x.idsl"
    path.write_text(text)
    report = Report()
    modules = check_idsl(path, case_workspace(), report)
    assert [item for item in report if item.severity == "error"] == []
    assert modules is not None
    return modules[-1]


def operation_of(text: str, tmp_path: Path) -> Operation:
    """An operation in an interface beside some types."""
    structs = """
        struct Req { int a; }; struct Outcome { int b; }; struct SayResponse { int c; };
        struct BusyRESP { int d; }; enum Mode { Idle }; exception Failed { string what; };
    """
    module = module_of(f"module M {{ {structs} interface I {{ {text} }}; }};", tmp_path)
    (interface,) = module.interfaces
    return interface.operations[0]


def component_case(case: str) -> Component:
    """The component of a case."""
    found = check_cdsl(CASES / "cdsl" / case, case_workspace(), Report())
    assert found is not None
    return found


def deployment_case(case: str, tmp_path: Path | None = None, text: str = "") -> Deployment:
    """The deployment of a case, or of `text` in `tmp_path`."""
    path = CASES / "ddsl" / case / "main.ddsl"
    if tmp_path:
        path = tmp_path / "main.ddsl"
        path.write_text(text)
    report = Report()
    found = check_ddsl(path, case_workspace(), report)
    assert found is not None
    assert not report.has_errors
    return found


def connection_lines(model: Deployment) -> list[str]:
    """The connections, one line each."""
    return [
        f"{c.source.name}.{c.source_port.name} -> {c.target.name}.{c.target_port.name}"
        + (" implied" if c.implied else "")
        for c in model.connections
    ]

"""Where definitions of YARP are found, and what modules they become."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl, check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Module, Pattern
from tests.generate.golden_cases import GOLDEN


def put(path: Path, field: str) -> None:
    """A definition whose only field has this name."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"struct Reading {{ 1: i32 {field} }}\n")


def checked(text: str, folder: Path, workspace: Workspace) -> tuple[Module, Report]:
    path = folder / "Demo.idsl"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    report = Report()
    modules = check_idsl(path, workspace, report)
    assert modules
    return modules[-1], report


def first_field(written: str, folder: Path, workspace: Workspace) -> str:
    """The first field of the struct in the definition that an import finds."""
    module, report = checked(f'import "{written}";\nmodule Demo {{ }};\n', folder, workspace)
    assert not report.has_errors, [finding.message for finding in report]
    (struct,) = module.imports[0].declarations
    assert isinstance(struct, types.Struct)
    return struct.fields[0].name


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    environ = {"ROBOCOMP_INTERFACES": f"{tmp_path / 'listed'}"}
    return Workspace([tmp_path / "given"], environ, shipped=tmp_path / "shipped")


@pytest.fixture
def motor() -> Module:
    """The module of tests/golden/thrift/motor.thrift."""
    report = Report()
    modules = check_idsl(GOLDEN / "thrift" / "motor.thrift", Workspace(environ={}), report)
    assert modules
    assert not list(report)
    return modules[0]


def test_yarp_definition_is_found_in_first_folder(tmp_path: Path, workspace: Workspace) -> None:
    for folder in ("shipped", "listed", "given", "here"):
        put(tmp_path / folder / "idl" / "motor.thrift", f"in_{folder}")
        found = first_field("idl/motor.thrift", tmp_path / "here", workspace)
        assert found == f"in_{folder}"


def test_last_part_of_path_is_found_in_folders(tmp_path: Path, workspace: Workspace) -> None:
    put(tmp_path / "outside" / "motor.thrift", "outside")
    put(tmp_path / "given" / "motor.thrift", "given")
    for written in ("idl/motor.thrift", "../outside/motor.thrift",
                    f"{tmp_path}/outside/motor.thrift"):  # fmt: skip
        assert first_field(written, tmp_path / "here", workspace) == "given"


def test_include_is_found_beside_the_including_file(tmp_path: Path, workspace: Workspace) -> None:
    put(tmp_path / "here" / "part.thrift", "beside_the_root")
    put(tmp_path / "given" / "idl" / "part.thrift", "beside")
    whole = 'include "part.thrift"\nstruct Whole { 1: part.Reading part }\n'
    (tmp_path / "given" / "idl" / "whole.thrift").write_text(whole)
    text = 'import "idl/whole.thrift";\nmodule Demo { };\n'
    module, report = checked(text, tmp_path / "here", workspace)
    assert not list(report)
    (struct,) = module.imports[0].declarations
    assert isinstance(struct, types.Struct)
    part = struct.fields[0].type
    assert isinstance(part, types.Struct)
    assert [field.name for field in part.fields] == ["beside"]


def test_edited_thrift_definition_is_read_again(tmp_path: Path, workspace: Workspace) -> None:
    path = tmp_path / "here" / "motor.thrift"
    put(path, "first")
    assert first_field("motor.thrift", tmp_path / "here", workspace) == "first"
    workspace.sources.set_overlay(path, "struct Reading { 1: i32 edited }")
    assert first_field("motor.thrift", tmp_path / "here", workspace) == "edited"


def test_service_becomes_an_interface_of_style_thrift(motor: Module) -> None:
    base, interface = motor.interfaces
    assert (base.style, interface.style, motor.origin) == ("thrift", "thrift", "thrift")
    assert interface.base is base
    assert interface.operations[0].span == base.operations[0].span
    assert [operation.name for operation in interface.own_operations] == [
        "move_to", "follow", "stop", "get_status", "reset",
    ]  # fmt: skip
    patterns = {operation.name: operation.pattern for operation in interface.operations}
    assert patterns["stop"] is Pattern.COMMAND
    assert patterns["reset"] is Pattern.UNMARKED
    assert patterns["move_to"] is Pattern.QUERY
    move = interface.operations[1]
    assert [exception.name for exception in move.throws] == ["Blocked"]
    assert [(p.name, p.type, p.unit) for p in move.inputs] == [
        ("angle", types.DOUBLE, "deg"),
        ("speed", types.DOUBLE, ""),  # a typedef of the included file
    ]
    assert [(p.name, p.default) for p in move.optional_inputs] == [("speed", 10.0)]


def test_interface_of_idsl_has_no_style(tmp_path: Path, workspace: Workspace) -> None:
    text = "module Demo { interface I { void go(); }; };\n"
    module, _ = checked(text, tmp_path / "here", workspace)
    assert [interface.style for interface in module.interfaces] == [""]


def test_typedef_stands_for_its_type(tmp_path: Path, workspace: Workspace) -> None:
    (tmp_path / "given").mkdir()
    (tmp_path / "given" / "ports.thrift").write_text("typedef i32 Port\ntypedef Port Other\n")
    text = 'import "ports.thrift";\nmodule Demo { struct S { ports::Other port = 3; Port p; }; };\n'
    module, report = checked(text, tmp_path / "here", workspace)
    assert not list(report)
    (struct,) = module.declarations
    assert isinstance(struct, types.Struct)
    assert [field.type for field in struct.fields] == [types.INT, types.INT]
    assert [alias.name for alias in module.imports[0].aliases] == ["Port", "Other"]


def test_component_imports_thrift_services(tmp_path: Path) -> None:
    (tmp_path / "motor.thrift").write_text("service Motor { bool stop() }\n")
    path = tmp_path / "x.cdsl"
    path.write_text(
        'import "motor.thrift";\n'
        "Component x { Communications { implements Motor; }; language Python; };\n"
    )
    report = Report()
    component = check_cdsl(path, Workspace(environ={}), report)
    assert not list(report)
    assert component
    (port,) = component.ports
    assert isinstance(port.interface, Interface)
    assert (port.interface.qualified, port.interface.style) == ("motor::Motor", "thrift")

"""Changes of Thrift definitions that a compared IDSL file imports."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.breaking.compare import Version, compare
from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report


def version(folder: Path, definition: str) -> Version:
    """The models of an IDSL file that imports a Thrift definition with this text."""
    folder.mkdir()
    (folder / "motor.thrift").write_text(definition)
    (folder / "Demo.idsl").write_text(
        'import "motor.thrift";\nmodule Demo { struct S { motor::Status status; }; };\n'
    )
    report, found = Report(), Version()
    found.add(check_idsl(folder / "Demo.idsl", Workspace(environ={}), report))
    assert not report.has_errors
    return found


def test_changes_of_imported_thrift_definition_are_breaking(tmp_path: Path) -> None:
    struct = "struct Status {{ 1: {} x, 2: list<{}> y }}\nservice Motor {{ {} }}\n"
    old = version(tmp_path / "old", struct.format("i32", "i32", "bool go(1: i32 x) bool stop()"))
    new = version(tmp_path / "new", struct.format("i64", "i32", "bool go(1: double x)"))
    report = Report()
    compare(old, new, (), report)
    found = [f"{finding.code.id}: {finding.message}" for finding in report.sorted()]
    assert "RC641: `motor::Status.x` was int, now long" in found
    assert any("`stop`" in text for text in found)
    assert any("go" in text and "double" in text for text in found)
    same = Report()
    compare(old, old, (), same)
    assert not list(same)

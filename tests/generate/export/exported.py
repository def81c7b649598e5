"""Helpers of the tests of exports: modules of files, and files written to a folder."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.output import render
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import ExportResult, export
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.model.interface import Module
from robocomp_dsl.resources import INTERFACES

SHIPPED = sorted(path.name for path in INTERFACES.glob("*.idsl"))


def modules(path: Path) -> tuple[Module, ...]:
    """The modules of a file without errors."""
    report = Report()
    found = check_idsl(path, Workspace(environ={}), report)
    assert found, render.full(report)
    assert not report.has_errors, render.full(report)
    return found


def exported(text: str, to: str, folder: Path) -> ExportResult:
    """The export of a text."""
    path = folder / "Text.idsl"
    path.write_text(text)
    return export(modules(path), to)


def put(files: Iterable[OutputFile], folder: Path) -> None:
    """Write files into a folder."""
    for file in files:
        path = folder / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(file.data)

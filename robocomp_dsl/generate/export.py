"""Export interfaces for tools that do not read IDSL: the formats, and their common code.

In: the resolved modules of one IDSL file. Out: an `ExportResult`: files, and findings about renamed
or changed declarations. Nothing is written to disk here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.model.interface import Module
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span

FORMATS = {
    "slice": "robocomp_dsl.generate.exports.slice",
    "ros2": "robocomp_dsl.generate.exports.ros2",
    "json-schema": "robocomp_dsl.generate.exports.json_schema",
}
"""Formats, and the module of each, which has `files(modules, alone, report)`."""

Writer = Callable[[Sequence[Module], bool, Report], Iterable[OutputFile]]


class ExportResult(ValueRecord):
    """The result of an export. There are no files if a finding is an error."""

    files: tuple[OutputFile, ...]
    findings: tuple[Diagnostic, ...]


def export(modules: Sequence[Module], output_format: str, *, alone: bool = False) -> ExportResult:
    """The `modules` of one file in the format `to`; with what they import, unless `alone`.

    Raises `KeyError` for a format that is not in `FORMATS`.
    """
    write: Writer = import_module(FORMATS[output_format]).files
    report = Report()
    files = tuple(write(modules, alone, report))
    return ExportResult(() if report.has_errors else files, tuple(report.sorted()))


def transitive_modules(modules: Iterable[Module]) -> tuple[Module, ...]:
    """`modules` and all modules that they import, each once, imported modules first."""
    return tuple(dict.fromkeys(imported for module in modules for imported in module.closure()))


def modules_by_file(modules: Iterable[Module]) -> dict[Path, list[Module]]:
    """Modules by their file, in order."""
    by_file: dict[Path, list[Module]] = {}
    for module in modules:
        by_file.setdefault(module.path, []).append(module)
    return by_file


def report_renamed(report: Report, span: Span, old: str, new: str, why: str) -> None:
    """Report that `old` is named `new` in the exported files."""
    report.add(codes.RENAMED_IN_EXPORT, span, f"`{old}` is exported as `{new}`: {why}")

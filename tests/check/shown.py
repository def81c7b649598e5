"""Findings as the texts that stand beside the cases."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Span


def shown(report: Report, folder: Path) -> str:
    """All findings with everything that they say; paths are relative to `folder`."""
    lines = [line for one in report.sorted() for line in _lines(one, folder)]
    return "\n".join(lines or ["nothing found"]) + "\n"


def _lines(one: Diagnostic, folder: Path) -> list[str]:
    place = _place(one.span, folder)
    lines = [f"{place} {one.severity} {one.code.id}: {one.message}"]
    lines += [f"    label: {one.label}"] if one.label else []
    lines += [f"    note: {_place(note.span, folder)} {note.message}" for note in one.notes]
    lines += [f"    help: {one.help}"] if one.help else []
    if one.fix:
        edits = [f"{_place(edit.span, folder)} {edit.text!r}" for edit in one.fix.edits]
        lines.append(f"    fix: {one.fix.title}: {'; '.join(edits)}")
    return lines


def _place(span: Span, folder: Path) -> str:
    path = span.source.path
    name = path.relative_to(folder) if path.is_relative_to(folder) else path
    (line, column), (end_line, end_column) = span.begin, span.finish
    end = str(end_column) if line == end_line else f"{end_line}:{end_column}"
    return f"{name.as_posix()}:{line}:{column}-{end}"

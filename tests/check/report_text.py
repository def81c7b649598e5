"""Findings as text, for the expected output beside the cases."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Span


def report_text(report: Report, folder: Path) -> str:
    """All findings with labels, notes, help and fixes; paths are relative to `folder`."""
    lines = [line for diagnostic in report.sorted() for line in _lines(diagnostic, folder)]
    return "\n".join(lines or ["nothing found"]) + "\n"


def _lines(diagnostic: Diagnostic, folder: Path) -> list[str]:
    place = _place(diagnostic.span, folder)
    lines = [f"{place} {diagnostic.severity} {diagnostic.code.id}: {diagnostic.message}"]
    lines += [f"    label: {diagnostic.label}"] if diagnostic.label else []
    lines += [f"    note: {_place(note.span, folder)} {note.message}" for note in diagnostic.notes]
    lines += [f"    help: {diagnostic.help}"] if diagnostic.help else []
    if diagnostic.fix:
        edits = [f"{_place(edit.span, folder)} {edit.text!r}" for edit in diagnostic.fix.edits]
        lines.append(f"    fix: {diagnostic.fix.title}: {'; '.join(edits)}")
    return lines


def _place(span: Span, folder: Path) -> str:
    path = span.source.path
    name = path.relative_to(folder) if path.is_relative_to(folder) else path
    (line, column), (end_line, end_column) = span.start_position, span.end_position
    end = str(end_column) if line == end_line else f"{end_line}:{end_column}"
    return f"{name.as_posix()}:{line}:{column}-{end}"

"""Reads InnerModel files at run time, by the parser and the checks of `rcgen check`.

In: a path, or a text. Out: the resolved model with what `write` needs to save it. Errors are
raised together, each with its location; warnings are returned. Files that nodes name (meshes,
pictures, positions of taxels) are not read.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.innermodel.resolve import resolve_innermodel
from robocomp_dsl.check.innermodel.rules import check_nodes
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.model import innermodel
from robocomp_dsl.source import (
    Source,
    UnreadableSource,
    decode_with_encoding,
    read_source_bytes,
)


@dataclass(frozen=True, slots=True, eq=False)
class InnerModelFile:
    """A model, the text and encoding of its main file, and the warnings about it."""

    model: innermodel.InnerModel
    source: Source
    encoding: str
    warnings: tuple[Finding, ...] = ()


def read_file(path: Path) -> InnerModelFile:
    """The InnerModel file at `path` with all included files. Raises `InnerModelError`."""
    try:
        text, encoding = decode_with_encoding(read_source_bytes(path))
    except UnreadableSource as error:
        finding = Finding(Location(SourceText(str(path))), f"cannot read `{path}`: {error}")
        raise InnerModelError(finding.message, (finding,)) from None
    return parse_text(text, path, encoding)


def parse_text(text: str, path: Path, encoding: str = "utf-8") -> InnerModelFile:
    """The InnerModel in `text`; includes are relative to `path`. Raises `InnerModelError`."""
    files, report = SourceCache(), Report()
    source = files.set_overlay(path, text)
    model = resolve_innermodel(path, files, report)
    check_nodes(model, report)
    findings = [(d.severity, _finding(d)) for d in report.sorted()]
    errors = tuple(f for severity, f in findings if severity is Severity.ERROR)
    if errors:
        shown = "\n".join(finding.render(f"error[{finding.kind}]") for finding in errors)
        raise InnerModelError(shown, errors)
    return InnerModelFile(model, source, encoding, tuple(finding for _, finding in findings))


def _finding(diagnostic: Diagnostic) -> Finding:
    span = diagnostic.span
    line, column = span.start_position
    shown = span.source.line(line) if span.source.text else ""
    width = max(1, min(span.end - span.start, len(shown) - column + 1))
    text = SourceText(str(span.source.path), ("",) * (line - 1) + (shown,))
    return Finding(
        Location(text, line, column, width),
        diagnostic.message,
        diagnostic.label,
        diagnostic.help,
        diagnostic.code.id,
    )

"""Reports findings of URDF and MJCF files at their source locations.

In: findings with lines or names. Out: diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.generate import codes_model as codes
from robocomp_dsl.hardware.description.findings import ModelFileError, ModelFinding
from robocomp_dsl.source import Source, Span, UnreadableSource


def read_source(path: Path) -> Source:
    """The text of the file; empty if it is unreadable.

    MuJoCo also accepts large files and text other than UTF-8; findings then have no lines.
    """
    try:
        return Source.read(path)
    except UnreadableSource:
        return Source(path, "")


def report_faults(error: ModelFileError, source: Source, report: Report) -> None:
    """All errors that prevent a model."""
    for fault in error.faults:
        report.add(codes.MODEL_FILE, at_line(source, fault.line), fault.message)


def report_findings(findings: Iterable[ModelFinding], source: Source, report: Report) -> None:
    """Deviations from the file, at their line, or where their link or body starts."""
    for finding in findings:
        place = at_line(source, finding.line) if finding.line else _named(source, finding)
        report.add(code_of(finding), place, finding.message)


def code_of(finding: ModelFinding) -> Code:
    """The code of a finding."""
    return codes.MODEL_OVERLAP if finding.kind == "overlap" else codes.MODEL_SIMPLIFIED


def at_line(source: Source, number: int) -> Span:
    """A line without surrounding blanks; the whole text if there is no such line."""
    if not 0 < number <= len(source.line_starts):
        return source.file_span
    text = source.line(number)
    start = source.line_starts[number - 1] + len(text) - len(text.lstrip())
    return source.span(start, start + len(text.strip()))


def _named(source: Source, finding: ModelFinding) -> Span:
    """The tag of a finding's subject."""
    tags = "joint" if finding.kind == "joint" else "link|body"
    tag = rf"<(?:{tags})\b[^<>]*\bname\s*=\s*([\"']){re.escape(finding.subject)}\1"
    found = re.search(tag, source.text) if finding.subject else None
    return source.span(*found.span()) if found else source.file_span

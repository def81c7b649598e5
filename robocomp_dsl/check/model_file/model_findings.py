"""Reports findings of URDF and MJCF files at their source locations.

In: findings with lines or names. Out: diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.check.codes import model_files as codes
from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.source import Source, Span, UnreadableSource


def read_source(path: Path) -> Source:
    """The text of the file; empty if it is unreadable.

    MuJoCo also accepts large files and text other than UTF-8; findings then have no lines.
    """
    try:
        return Source.read(path)
    except UnreadableSource:
        return Source(path, "")


def report_error(error: ModelFileError, source: Source, report: Report) -> None:
    """All errors that prevent a model."""
    for finding in error.findings:
        report.add_finding(codes.MODEL_FILE, finding, source)


def report_findings(findings: Iterable[Finding], source: Source, report: Report) -> None:
    """Deviations from the file, at their line, or where their link or body starts."""
    for finding in findings:
        if finding.location.line:
            report.add_finding(code_of(finding), finding, source)
        else:
            report.add(code_of(finding), _named(source, finding), finding.message)


def code_of(finding: Finding) -> Code:
    """The code of a finding."""
    if finding.kind in ("unlikely", "range"):
        return codes.MODEL_UNLIKELY
    return codes.MODEL_OVERLAP if finding.kind == "overlap" else codes.MODEL_SIMPLIFIED


def _named(source: Source, finding: Finding) -> Span:
    """The tag of a finding's subject."""
    tags = "joint" if finding.kind in ("joint", "range") else "link|body"
    tag = rf"<(?:{tags})\b[^<>]*\bname\s*=\s*([\"']){re.escape(finding.subject)}\1"
    found = re.search(tag, source.text) if finding.subject else None
    return source.span(*found.span()) if found else source.file_span

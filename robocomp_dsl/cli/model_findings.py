"""What is told about a file in URDF or MJCF, at its places.

In: findings with lines or names. Out: diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.generate import codes_model as codes
from robocomp_dsl.hardware.findings import Finding, ModelFileError
from robocomp_dsl.source import Source, Span, UnreadableSource


def read_source(path: Path) -> Source:
    """The text of the file, empty where it cannot be told.

    MuJoCo takes what is not UTF-8, or very large; lines are left out then.
    """
    try:
        return Source.read(path)
    except UnreadableSource:
        return Source(path, "")


def tell_faults(error: ModelFileError, source: Source, report: Report) -> None:
    """All reasons why there is no model."""
    for fault in error.faults:
        report.add(codes.MODEL_FILE, at_line(source, fault.line), fault.said)


def tell(findings: Iterable[Finding], source: Source, report: Report) -> None:
    """What is not as described, at its line or where its link or body begins."""
    for one in findings:
        place = at_line(source, one.line) if one.line else _named(source, one)
        report.add(code_of(one), place, one.said)


def code_of(one: Finding) -> Code:
    """The code of a finding."""
    return codes.MODEL_OVERLAP if one.kind == "overlap" else codes.MODEL_SIMPLIFIED


def at_line(source: Source, number: int) -> Span:
    """A line without its blanks; the whole text for one that is not there."""
    if not 0 < number <= len(source.line_starts):
        return source.whole
    text = source.line(number)
    start = source.line_starts[number - 1] + len(text) - len(text.lstrip())
    return source.span(start, start + len(text.strip()))


def _named(source: Source, one: Finding) -> Span:
    """The tag of what a finding is about."""
    tags = "joint" if one.kind == "joint" else "link|body"
    tag = rf"<(?:{tags})\b[^<>]*\bname\s*=\s*([\"']){re.escape(one.subject)}\1"
    found = re.search(tag, source.text) if one.subject else None
    return source.span(*found.span()) if found else source.whole

"""Helpers of the tests of formatting."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.format.formatter import PARSERS, format_source
from robocomp_dsl.source import Source

CASES = Path(__file__).parent / "cases"
ROOT = Path(__file__).parent.parent.parent


def parse(name: str, text: str) -> tuple[object, Report]:
    """The tree of a text and its findings."""
    report = Report()
    path = Path(name)
    return PARSERS[path.suffix](Source(path, text), report), report


def fmt(name: str, text: str) -> str | None:
    """The formatted text, or None if it has errors."""
    return format_source(Source(Path(name), text), list(parse(name, text)[1]))

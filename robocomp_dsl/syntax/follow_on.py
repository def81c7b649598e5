"""Findings that only follow from a syntax error of the same file.

In: the diagnostics of a file. Out: those that follow from one of its syntax errors. They are not
reported: they mislead, and what is true of them shows when the syntax error is gone.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Protocol

from robocomp_dsl.diagnostics import Diagnostic, Report, UncertainText
from robocomp_dsl.source import Source

UNKNOWN_NAMES = frozenset(
    ("RC204", "RC206", "RC301", "RC501", "RC502", "RC503", "RC519", "RC560", "RC701")
)
"""A name that is declared nowhere."""

OMISSIONS = frozenset(("RC507", "RC508", "RC509", "RC522", "RC573", "RC702", "RC704", "RC556"))
"""Something is missing in the whole file; it may be what could not be read."""

_NAME = re.compile(r"[A-Za-z_]\w*")


class ParsedFile(Protocol):
    """A source with its syntax diagnostics."""

    @property
    def source(self) -> Source:
        """The text."""

    @property
    def diagnostics(self) -> Sequence[Diagnostic]:
        """The syntax diagnostics."""


def follow_on_errors(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics that follow from a syntax error; all are about one file."""
    diagnostics = list(diagnostics)
    uncertain = [found.uncertain for found in diagnostics if found.uncertain]
    if not uncertain:
        return []
    return [d for d in diagnostics if d.uncertain is None and _follows(d, uncertain)]


def discard_follow_on_errors(report: Report, file: ParsedFile) -> None:
    """Remove from the report what follows from a syntax error of `file`."""
    if any(found.uncertain for found in file.diagnostics):
        report.discard(follow_on_errors(d for d in report if d.span.source is file.source))


def _follows(diagnostic: Diagnostic, uncertain: list[UncertainText]) -> bool:
    span, code = diagnostic.span, diagnostic.code.id
    if any(text.span.start <= span.start and span.end <= text.span.end for text in uncertain):
        return True
    if code in OMISSIONS:
        return True
    if code not in UNKNOWN_NAMES:
        return False
    words = _NAME.findall(span.text)
    return any(text.declares or not text.names.isdisjoint(words) for text in uncertain)

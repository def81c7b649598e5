"""Findings that only follow from a syntax error, by their place.

In: the diagnostics of a file. Out: those about text whose meaning is a guess after a syntax error.
They are not reported: they mislead, and what is true of them shows when the syntax error is gone.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.syntax.codes import syntax as codes

_TOKENS = frozenset(
    (
        codes.UNCLOSED_STRING.id,
        codes.UNCLOSED_COMMENT.id,
        codes.WRONG_QUOTES.id,
        codes.MERGE_CONFLICT.id,
    )
)
"""An invalid token is one whatever the statement means."""


def about_uncertain_text(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics within the uncertain text of another one; all are about one file."""
    diagnostics = list(diagnostics)
    spans = [found.uncertain.span for found in diagnostics if found.uncertain]
    return [
        found
        for found in diagnostics
        if found.uncertain is None
        and (found.severity is Severity.ERROR or not found.code.id.startswith("RC1"))
        and found.code.id not in _TOKENS
        and any(s.start <= found.span.start and found.span.end <= s.end for s in spans)
    ]

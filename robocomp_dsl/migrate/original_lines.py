"""Findings about Python 2 modules, at the lines of the user's files.

In: findings about texts that were converted to Python 3. Out: the same findings, each at the line
of the original text that its line came from. A conversion may insert imports and split statements.
"""

from __future__ import annotations

from collections.abc import Sequence
from difflib import SequenceMatcher
from functools import cache

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, Span


class ConvertedSource(Source):
    """The text in Python 3 of the text `original` of the same file."""

    original: Source | None = None


def locate_in_originals(report: Report) -> None:
    """Move all findings and notes from converted texts to the original ones."""
    findings = list(report)
    report.discard(findings)
    report.extend(
        found.replace(
            span=_in_original(found.span),
            notes=tuple(note.replace(span=_in_original(note.span)) for note in found.notes),
        )
        for found in findings
    )


def _in_original(span: Span) -> Span:
    source = span.source
    if not isinstance(source, ConvertedSource) or source.original is None:
        return span
    if span == source.file_span:
        return source.original.file_span
    number, column = span.start_position
    line = _original_lines(source, source.original)[number - 1]
    if source.line(number) == source.original.line(line):
        return source.original.span_at(line, column, len(span.text.partition("\n")[0]))
    return source.original.span_at(line)


@cache
def _original_lines(converted: Source, original: Source) -> Sequence[int]:
    """The line (from 1) of the original text of each line of the converted one."""
    new, old = (source.text.splitlines() for source in (converted, original))
    last_line = max(len(old), 1)
    lines: list[int] = []
    matcher = SequenceMatcher(None, new, old, autojunk=False)
    for _, begin, end, old_begin, old_end in matcher.get_opcodes():
        last = min(max(old_end, old_begin + 1), last_line)
        lines += [min(old_begin + offset + 1, last) for offset in range(end - begin)]
    return [*lines, last_line]

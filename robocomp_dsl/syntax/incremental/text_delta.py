"""The difference between two versions of a text, as one edited range.

In: both texts. Out: the positions of the unchanged parts of the old text in the new one.
"""

from __future__ import annotations

import re

from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix, Note
from robocomp_dsl.source import Source, Span

_MERGE_MARKS = ("<" * 7, "|" * 7, "=" * 7, ">" * 7)
_MERGE_LINE = re.compile(r"^(?:<{7}|\|{7}|={7}|>{7})(?:[ \r\n]|\Z)", re.MULTILINE)


class StaleReference(Exception):
    """A diagnostic refers to edited text."""


class TextDelta:
    """`old[:start]` and `old[end:]` are unchanged in `new`, the second part moved by `offset`.

    `lookahead_limit` is the last offset at which a token may end such that its parsing did not
    depend on edited text: one line and one word before the edit. `is_local` is False if the meaning
    of one part of the text may depend on any other part (merge conflict markers).
    """

    def __init__(self, old: str, new: str) -> None:
        self.start = _common_prefix_length(old, new)
        behind = _common_suffix_length(old, new, min(len(old), len(new)) - self.start)
        self.end = len(old) - behind
        self.offset = len(new) - len(old)
        line, word = old.rfind("\n", 0, self.start), len(old[: self.start].rstrip()) - 1
        self.lookahead_limit = min(line, word)
        self.is_local = not (_has_merge_marks(old) or _has_merge_marks(new))

    def displacement(self, start: int, end: int) -> int | None:
        """By how much [start, end) of the new text has moved; None if it may have been edited."""
        if end < self.start:
            return 0
        return self.offset if start > self.end + self.offset else None

    def move_diagnostic(self, diagnostic: Diagnostic, source: Source) -> Diagnostic:
        """A diagnostic about the old text, moved to the new text `source`.

        Raises `StaleReference` if it refers to edited text.
        """

        def place(span: Span) -> Span:
            start, end = span.start, span.end
            if end < self.start:
                return source.span(start, end)
            if start <= self.end:
                raise StaleReference
            return source.span(start + self.offset, end + self.offset)

        notes = tuple(Note(place(note.span), note.message) for note in diagnostic.notes)
        fix = diagnostic.fix and Fix(
            diagnostic.fix.title,
            tuple(Edit(place(edit.span), edit.text) for edit in diagnostic.fix.edits),
        )
        uncertain = diagnostic.uncertain and diagnostic.uncertain.replace(
            span=place(diagnostic.uncertain.span)
        )
        return diagnostic.replace(
            span=place(diagnostic.span), notes=notes, fix=fix, uncertain=uncertain
        )


def _common_prefix_length(first: str, second: str) -> int:
    """The length of the common prefix."""
    low, high = 0, min(len(first), len(second))
    while low < high:
        middle = (low + high + 1) // 2
        if first[low:middle] == second[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def _common_suffix_length(first: str, second: str, most: int) -> int:
    """The length of the common suffix, at most `most`."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if first.endswith(second[len(second) - middle : len(second) - low], 0, len(first) - low):
            low = middle
        else:
            high = middle - 1
    return low


def _has_merge_marks(text: str) -> bool:
    return any(mark in text for mark in _MERGE_MARKS) and bool(_MERGE_LINE.search(text))

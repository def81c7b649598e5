"""The difference of two versions of a text, as one place that was edited.

In: both texts. Out: where the unchanged parts of the old one are in the new one.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix, Note
from robocomp_dsl.source import Source, Span

_MERGE_MARKS = ("<" * 7, "|" * 7, "=" * 7, ">" * 7)


class Changed(Exception):
    """Something refers to the text that was edited."""


class Edited:
    """`old[:start] + old[end:]` is also in `new`, the second part moved by `shift`.

    `seen_from` is the last place at which a token may end of which the edit cannot have been seen:
    a line and a word further on. `is_local` is False where what one part of a text means may depend
    on any other.
    """

    def __init__(self, old: str, new: str) -> None:
        self.start = _alike(old, new)
        rest = min(len(old), len(new)) - self.start
        behind = _alike(old[len(old) - rest :][::-1], new[len(new) - rest :][::-1])
        self.end = len(old) - behind
        self.shift = len(new) - len(old)
        line, word = old.rfind("\n", 0, self.start), len(old[: self.start].rstrip()) - 1
        self.seen_from = min(line, word)
        self.is_local = not any(mark in text for mark in _MERGE_MARKS for text in (old, new))

    def origin(self, start: int, end: int) -> int | None:
        """How far [start, end) of the new text was moved; None if it may have been edited."""
        if end < self.start:
            return 0
        return self.shift if start > self.end + self.shift else None

    def moved(self, one: Diagnostic, source: Source) -> Diagnostic:
        """A finding about the old text as one about `source`, the new one. Raises `Changed`."""

        def place(span: Span) -> Span:
            start, end = span.start, span.end
            if end < self.start:
                return source.span(start, end)
            if start <= self.end:
                raise Changed
            return source.span(start + self.shift, end + self.shift)

        notes = tuple(Note(place(note.span), note.message) for note in one.notes)
        fix = one.fix and Fix(
            one.fix.title, tuple(Edit(place(edit.span), edit.text) for edit in one.fix.edits)
        )
        return one.replaced(span=place(one.span), notes=notes, fix=fix)


def _alike(one: str, other: str) -> int:
    """How many characters both begin with."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low

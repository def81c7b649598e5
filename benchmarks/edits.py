"""The kinds of edits of a text that a user makes, each as one replaced range.

In: a text and an offset. Out: the edit of each kind at the next fitting place after the offset.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from benchmarks.large_files import COMMENT

PASTED_LINES = 50


class TextEdit(NamedTuple):
    """Replace `[start, end)` by `text`."""

    start: int
    end: int
    text: str

    def apply(self, text: str) -> str:
        """The edited text."""
        return text[: self.start] + self.text + text[self.end :]

    def inverse(self, text: str) -> TextEdit:
        """The edit that undoes this one; `text` is the text before it."""
        return TextEdit(self.start, self.start + len(self.text), text[self.start : self.end])


def _found(pattern: str, text: str, at: int) -> re.Match[str]:
    """The first match after `at`, or the last one before it."""
    matches = list(re.finditer(pattern, text, re.MULTILINE))
    return next((match for match in matches if match.start() >= at), matches[-1])


def _inserted(pattern: str, put: str, *, before: bool = False) -> Callable[[str, int], TextEdit]:
    def edit(text: str, at: int) -> TextEdit:
        match = _found(pattern, text, at)
        offset = match.start() if before else match.end()
        return TextEdit(offset, offset, put)

    return edit


def _deleted(pattern: str) -> Callable[[str, int], TextEdit]:
    def edit(text: str, at: int) -> TextEdit:
        return TextEdit(*_found(pattern, text, at).span(), "")

    return edit


def _lines(text: str, at: int, count: int) -> tuple[int, int]:
    """The range of `count` whole lines after `at`."""
    start = text.find("\n", at) + 1
    end = start
    for _ in range(count):
        end = text.find("\n", end) + 1 or len(text)
    return start, end


def _pasted(text: str, at: int) -> TextEdit:
    start, end = _lines(text, min(at, len(text) - 1), PASTED_LINES)
    return TextEdit(start, start, text[start:end])


def _deleted_lines(text: str, at: int) -> TextEdit:
    return TextEdit(*_lines(text, min(at, len(text) - 1), PASTED_LINES), "")


_LINE = r"^[ \t]*(?!//)\w[^\n]*;[ \t]*\n"
KINDS: Mapping[str, Callable[[str, int], TextEdit]] = {
    "letter in a name": _inserted(r"[A-Za-z_]\w*(?=[^\n]*;$)", "x"),
    "letter in a comment": _inserted(re.escape(COMMENT[:-5]), "x"),
    "digit deleted": _deleted(r"\d"),
    "`;` deleted": _deleted(";"),
    "`;` inserted": _inserted(r";\n|[ \t]\w", ";", before=True),
    "`{` deleted": _deleted(r"\{"),
    "`}` deleted": _deleted(r"\}"),
    "`};` deleted": _deleted(r"\};"),
    "stray `{`": _inserted(_LINE, "    {\n"),
    "stray `}`": _inserted(_LINE, "    }\n"),
    "stray `};`": _inserted(_LINE, "    };\n"),
    "stray `)`": _inserted(r"\w(?=[ ;])", ")"),
    "word deleted": _deleted(r"[A-Za-z_]\w*"),
    "unclosed string": _inserted(_LINE, '"'),
    "unclosed comment": _inserted(_LINE, "/*"),
    "line inserted": _inserted(_LINE, "    int fresh;\n"),
    "empty line": _inserted("$", "\n"),
    "line deleted": _deleted(_LINE),
    "50 lines pasted": _pasted,
    "50 lines deleted": _deleted_lines,
}
"""Kind of edit to the function that makes it at or after an offset."""

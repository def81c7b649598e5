"""The lines of the new text, and the alignment of trailing comments.

In: lines with their trailing comments. Out: the text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from robocomp_dsl.format.style import WIDTH
from robocomp_dsl.format.tokens import FormatToken

_GAP = 2
"""Spaces before a trailing comment."""


@dataclass(slots=True)
class Line:
    """A line (several for a multi-line comment or string); `note` is its trailing comment."""

    code: str = ""
    note: str = ""


def text_of(lines: Iterable[Line]) -> str:
    """The lines as text; trailing comments of adjacent statements start in the same column."""
    result: list[str] = []
    for _, run in groupby(lines, key=_neighbourhood):
        result += _aligned(list(run))
    return "".join(f"{token}\n" for token in result)


def _neighbourhood(token: Line) -> tuple[bool, int, bool]:
    """The key that adjacent lines must share to be aligned; lines with braces are separate."""
    if not token.note:
        return False, 0, False
    words = token.code.lstrip()
    return True, len(token.code) - len(words), words.startswith(("{", "}"))


def _aligned(run: Sequence[Line]) -> Iterator[str]:
    widths = [len(token.code.rpartition("\n")[2]) for token in run]
    column = max(widths)
    if any(column + _GAP + len(token.note.partition("\n")[0]) > WIDTH for token in run):
        column = 0
    for token, width in zip(run, widths, strict=True):
        blanks = " " * (max(column - width, 0) + _GAP)
        yield f"{token.code}{blanks}{token.note}" if token.note else token.code


def reindent(comment: FormatToken, indent: str) -> str:
    """The text of a comment after `indent`; its further lines move with the first line.

    Columns of stars are aligned. Lines that do not start with the margin of the first line stay
    unchanged, because their alignment is unknown.
    """
    first, *others = comment.text.split("\n")
    if not others or comment.margin is None:
        return comment.text
    old = comment.margin
    if all(not line or line.lstrip().startswith("*") for line in others):
        others = [f"{indent} {line.lstrip()}" if line else line for line in others]
    elif all(not line or line.startswith(old) for line in others):
        others = [indent + line[len(old) :] if line else line for line in others]
    return "\n".join((first, *others))

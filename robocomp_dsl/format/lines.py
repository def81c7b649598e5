"""Lines of the new text, and how comments stand on them.

In: lines with the comments behind them. Out: the text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from robocomp_dsl.format.pieces import Piece
from robocomp_dsl.format.style import WIDTH

_GAP = 2
"""Blanks in front of a comment that stands behind something."""


@dataclass(slots=True)
class Line:
    """A line, or several where a comment or a text has them; `note` is the comment behind it."""

    code: str = ""
    note: str = ""


def text_of(lines: Iterable[Line]) -> str:
    """The lines as one text; comments behind neighbouring statements begin in the same column."""
    made: list[str] = []
    for _, run in groupby(lines, key=_neighbourhood):
        made += _aligned(list(run))
    return "".join(f"{one}\n" for one in made)


def _neighbourhood(one: Line) -> tuple[bool, int, bool]:
    """What neighbouring lines must share to be aligned; braces stand for themselves."""
    if not one.note:
        return False, 0, False
    words = one.code.lstrip()
    return True, len(one.code) - len(words), words.startswith(("{", "}"))


def _aligned(run: Sequence[Line]) -> Iterator[str]:
    widths = [len(one.code.rpartition("\n")[2]) for one in run]
    column = max(widths)
    if any(column + _GAP + len(one.note.partition("\n")[0]) > WIDTH for one in run):
        column = 0
    for one, width in zip(run, widths, strict=True):
        blanks = " " * (max(column - width, 0) + _GAP)
        yield f"{one.code}{blanks}{one.note}" if one.note else one.code


def reindented(comment: Piece, indent: str) -> str:
    """A comment in front of which `indent` will stand; its further lines move as the first does.

    Rows of stars are put in line. Lines that do not begin with what stands in front of the first
    are left alone: nobody knows what they are aligned with.
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

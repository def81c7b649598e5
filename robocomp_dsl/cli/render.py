"""Findings for people: the excerpt with carets, in colours where the terminal has them.

In: diagnostics. Out: text. Everything that comes from a file or a path is made harmless first:
control characters must not reach the terminal.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.record import Value
from robocomp_dsl.source import Span

TAB = 4
LONGEST = 160
"""Columns of an excerpt, at most; of a longer line only the part around the carets is shown."""
MARGIN = 40
SHOWN_LINES = 4
"""Lines of an excerpt, at most; of more only the first and the last are shown."""

_COLOURS = {Severity.ERROR: "1;31", Severity.WARNING: "1;33", Severity.NOTE: "1;36"}
_FRAME = "1;34"
_STRONG = "1"


class Painter(Value):
    """Puts colours around texts, or leaves them as they are."""

    colours: bool

    def __call__(self, text: str, style: str) -> str:
        """`text` in the style of an SGR code (ECMA-48, section 8.3.117)."""
        return f"\x1b[{style}m{text}\x1b[0m" if self.colours and text else text


def full(findings: Iterable[Diagnostic], *, colours: bool = False) -> str:
    """All findings, each with its excerpt, an empty line between them."""
    paint = Painter(colours)
    return "\n".join("".join(f"{line}\n" for line in _finding(d, paint)) for d in findings)


def harmless(text: str) -> str:
    """`text` without characters that could steer a terminal."""
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


def shown_path(path: Path) -> str:
    """`path` as short as it stays clear: relative where it is below the working folder."""
    try:
        return harmless(str(path.relative_to(Path.cwd())))
    except (ValueError, OSError):
        return harmless(str(path))


def _finding(one: Diagnostic, paint: Painter) -> Iterator[str]:
    style = _COLOURS[one.severity]
    head = paint(f"{one.severity}[{one.code.id}]", style)
    yield head + paint(f": {harmless(one.message)}", _STRONG)
    yield from _excerpt(one.span, one.label, style, paint)
    for note in one.notes:
        style = _COLOURS[Severity.NOTE]
        yield paint("note", style) + f": {harmless(note.message)}"
        yield from _excerpt(note.span, "", style, paint)
    if one.help:
        yield paint("help", _COLOURS[Severity.NOTE]) + f": {harmless(one.help)}"
    elif one.fix:
        yield paint("help", _COLOURS[Severity.NOTE]) + f": {harmless(one.fix.title)}"


def _excerpt(span: Span, label: str, style: str, paint: Painter) -> Iterator[str]:
    (line, column), (last, _) = span.begin, span.finish
    gutter = len(str(last)) + 1
    bar = paint(" " * gutter + " |", _FRAME)
    yield paint(" " * gutter + "--> ", _FRAME) + f"{shown_path(span.source.path)}:{line}:{column}"
    if not span.source.text:
        return
    yield bar
    rows = list(_rows(span))
    for number, text, start, end, ends in rows:
        if number is None:
            yield paint("." * 3, _FRAME)
            continue
        yield paint(f"{number:>{gutter}} |", _FRAME) + (f" {text}" if text else "")
        said = f" {harmless(label)}" if label and ends else ""
        yield bar + " " * (start + 1) + paint("^" * max(end - start, 1) + said, style)


_Row = tuple[int | None, str, int, int, bool]
"""Line number (None: left out), text, columns of the carets [start, end), whether the span ends."""


def _rows(span: Span) -> Iterator[_Row]:
    (first, begin), (last, finish) = span.begin, span.finish
    if last > first and finish == 1:  # it ends with a line end: nothing of the next line is in it
        last -= 1
        finish = len(span.source.line(last)) + 1
    left_out = range(first + SHOWN_LINES - 1, last) if last - first >= SHOWN_LINES else range(0)
    for number in range(first, last + 1):
        if number in left_out:
            if number == left_out.start:
                yield None, "", 0, 0, False
            continue
        text = span.source.line(number)
        if not text.strip() and first < number < last:
            continue
        start = begin - 1 if number == first else len(text) - len(text.lstrip())
        end = finish - 1 if number == last else len(text)
        yield number, *_columns(text, start, end), number == last


def _columns(text: str, start: int, end: int) -> tuple[str, int, int]:
    """`text` as it is shown, and where its characters [start, end) stand then."""
    low = 0
    if len(text) > LONGEST:
        low = max(0, min(start - MARGIN, len(text) - LONGEST))
        text = text[low : low + LONGEST]
    start, end = (min(max(at - low, 0), len(text) + 1) for at in (start, end))
    shown, places = "\N{HORIZONTAL ELLIPSIS}" if low else "", []
    column = len(shown)
    for character in text:
        places.append(column)
        cell = " " * (TAB - column % TAB) if character == "\t" else harmless(character)
        shown += cell
        column += len(cell) if character == "\t" else _width(character)
    places += [column, column + 1]
    return shown.rstrip(), places[start], places[min(end, len(text))]


def _width(character: str) -> int:
    """Columns of one character on a terminal (Unicode Standard Annex 11)."""
    if unicodedata.combining(character) or unicodedata.category(character) in ("Mn", "Me"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1

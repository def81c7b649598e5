"""Findings as text: the excerpt with carets, in colours if the terminal supports them.

In: diagnostics. Out: text. Control characters in files and paths are escaped, so that they do not
reach the terminal.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span

TAB = 4
MAX_EXCERPT_COLUMNS = 160
"""Maximum columns of an excerpt; of a longer line only the part around the carets is shown."""
MARGIN = 40
MAX_EXCERPT_LINES = 4
"""Maximum lines of an excerpt; of more only the first and the last are shown."""

_COLOURS = {Severity.ERROR: "1;31", Severity.WARNING: "1;33", Severity.NOTE: "1;36"}
_FRAME = "1;34"
_STRONG = "1"


class AnsiStyler(ValueRecord):
    """Adds colours to texts, or leaves them unchanged."""

    colours: bool

    def __call__(self, text: str, style: str) -> str:
        """`text` in the style of an SGR code (ECMA-48, section 8.3.117)."""
        return f"\x1b[{style}m{text}\x1b[0m" if self.colours and text else text


def full(findings: Iterable[Diagnostic], *, colours: bool = False) -> str:
    """All findings, each with its excerpt, an empty line between them."""
    paint = AnsiStyler(colours)
    return "\n".join("".join(f"{line}\n" for line in _finding(d, paint)) for d in findings)


def strip_control_chars(text: str) -> str:
    """`text` without characters that control a terminal."""
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


def display_path(path: Path) -> str:
    """The shortest unambiguous `path`: relative if it is below the working folder."""
    try:
        return strip_control_chars(str(path.relative_to(Path.cwd())))
    except (ValueError, OSError):
        return strip_control_chars(str(path))


def _finding(finding: Diagnostic, paint: AnsiStyler) -> Iterator[str]:
    style = _COLOURS[finding.severity]
    head = paint(f"{finding.severity}[{finding.code.id}]", style)
    yield head + paint(f": {strip_control_chars(finding.message)}", _STRONG)
    yield from _excerpt(finding.span, finding.label, style, paint)
    for note in finding.notes:
        style = _COLOURS[Severity.NOTE]
        yield paint("note", style) + f": {strip_control_chars(note.message)}"
        yield from _excerpt(note.span, "", style, paint)
    if finding.help:
        yield paint("help", _COLOURS[Severity.NOTE]) + f": {strip_control_chars(finding.help)}"
    elif finding.fix:
        yield paint("help", _COLOURS[Severity.NOTE]) + f": {strip_control_chars(finding.fix.title)}"


def _excerpt(span: Span, label: str, style: str, paint: AnsiStyler) -> Iterator[str]:
    (line, column), (last, _) = span.start_position, span.end_position
    gutter = len(str(last)) + 1
    bar = paint(" " * gutter + " |", _FRAME)
    yield paint(" " * gutter + "--> ", _FRAME) + f"{display_path(span.source.path)}:{line}:{column}"
    if not span.source.text:
        return
    yield bar
    rows = list(_excerpt_rows(span))
    for number, text, start, end, ends in rows:
        if number is None:
            yield paint("." * 3, _FRAME)
            continue
        yield paint(f"{number:>{gutter}} |", _FRAME) + (f" {text}" if text else "")
        message = f" {strip_control_chars(label)}" if label and ends else ""
        yield bar + " " * (start + 1) + paint("^" * max(end - start, 1) + message, style)


_Row = tuple[int | None, str, int, int, bool]
"""Line number (None: omitted), text, columns of the carets [start, end), whether the span ends."""


def _excerpt_rows(span: Span) -> Iterator[_Row]:
    (first, begin), (last, finish) = span.start_position, span.end_position
    if last > first and finish == 1:  # it ends with a line end: nothing of the next line is in it
        last -= 1
        finish = len(span.source.line(last)) + 1
    left_out = (
        range(first + MAX_EXCERPT_LINES - 1, last)
        if last - first >= MAX_EXCERPT_LINES
        else range(0)
    )
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
    """`text` as displayed, and the columns of its characters [start, end)."""
    low = 0
    if len(text) > MAX_EXCERPT_COLUMNS:
        low = max(0, min(start - MARGIN, len(text) - MAX_EXCERPT_COLUMNS))
        text = text[low : low + MAX_EXCERPT_COLUMNS]
    start, end = (min(max(at - low, 0), len(text) + 1) for at in (start, end))
    shown, places = "\N{HORIZONTAL ELLIPSIS}" if low else "", []
    column = len(shown)
    for character in text:
        places.append(column)
        cell = " " * (TAB - column % TAB) if character == "\t" else strip_control_chars(character)
        shown += cell
        column += len(cell) if character == "\t" else _width(character)
    places += [column, column + 1]
    return shown.rstrip(), places[start], places[min(end, len(text))]


def _width(character: str) -> int:
    """Columns of one character on a terminal (Unicode Standard Annex 11)."""
    if unicodedata.combining(character) or unicodedata.category(character) in ("Mn", "Me"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1

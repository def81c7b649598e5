"""One problem in what the user gave, in the shape that all packages share.

In: messages and locations from readers and checks. Out: `Finding`. A component prints it with
`render`; a command gives it a code and reports it as a diagnostic (`Report.add_finding`). Running
components use this module, so it knows neither sources nor codes.
"""

from __future__ import annotations

import re

from robocomp_dsl.record import ValueRecord

_SHOWN_WIDTH = 160
_WORD = re.compile(r"[^\s,:{}\[\]<>]*")


class SourceText(ValueRecord):
    """The text that findings point into; `name` is its file, or the option it was given with."""

    name: str
    lines: tuple[str, ...] = ()

    @classmethod
    def of_text(cls, name: object, text: str) -> SourceText:
        """The lines of `text`."""
        return cls(str(name), tuple(text.splitlines()))

    def word_at(self, line: int, column: int) -> Location:
        """The word that begins there; where none begins, the rest of the line."""
        rest = self.lines[line - 1][column - 1 :] if 0 < line <= len(self.lines) else ""
        word = _WORD.match(rest)
        return Location(self, line, column, max(1, word.end() if word and word[0] else len(rest)))


class Location(ValueRecord):
    """`width` characters at `line` and `column` of a text; both count from 1, 0 is unknown."""

    text: SourceText
    line: int = 0
    column: int = 0
    width: int = 1

    @property
    def file(self) -> str:
        """The name of the text; empty if it is unknown."""
        return self.text.name

    @property
    def excerpt(self) -> str:
        """The line of the location; empty if it is unknown or after the end of the text."""
        lines = self.text.lines
        return lines[self.line - 1] if 0 < self.line <= len(lines) else ""

    def __str__(self) -> str:
        numbers = [str(number) for number in (self.line, self.column) if number]
        if self.file:
            return ":".join([self.file, *numbers])
        return f"line {':'.join(numbers)}" if numbers else ""


NOWHERE = Location(SourceText(""))
"""The location of a finding about something that has none."""


class Finding(ValueRecord):
    """One problem. `label` is shown beside the carets, `help` suggests a fix.

    `kind` selects the code that a command reports, from the kinds of the package that found it;
    `subject` is the name of the item that the finding is about. Both may be empty.
    """

    location: Location
    message: str
    label: str = ""
    help: str = ""
    kind: str = ""
    subject: str = ""

    def __str__(self) -> str:
        """The finding in one line."""
        where = str(self.location)
        text = f"{where}: {self.message}" if where else self.message
        return f"{text} ({self.help})" if self.help else text

    def render(self, severity: str = "error") -> str:
        """The finding in several lines, with the excerpt of the text and carets below.

        The first line begins with `severity`, unless that is empty.
        """
        lines = [f"{severity}: {self.message}" if severity else self.message]
        if where := str(self.location):
            lines.append(f"  --> {where}")
        if self.location.excerpt:
            lines += _excerpt(self.location, self.label)
        elif self.label:
            lines.append(f"note: {self.label}")
        if self.help:
            lines.append(f"help: {self.help}")
        return "\n".join(lines)


def _excerpt(location: Location, label: str) -> list[str]:
    """The line, cut to the width of a terminal, with carets below."""
    before = max(0, location.column - 1)
    cut = max(0, before - _SHOWN_WIDTH // 2)
    shown = location.excerpt[cut : cut + _SHOWN_WIDTH].replace("\t", " ")
    carets = "^" * max(1, min(location.width, len(shown) - (before - cut)))
    number = str(location.line)
    margin = " " * len(number)
    indent = " " * (before - cut)
    return [
        f" {margin} |",
        f" {number} | {shown}",
        f" {margin} | {indent}{carets} {label}".rstrip(),
    ]

"""Findings in a configuration: locations, messages, and their text format.

In: messages and locations from the readers and checks. Out: `ConfigError`, whose text shows every
finding with file, line, excerpt and caret.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches


@dataclass(frozen=True, slots=True, eq=False)
class ConfigText:
    """The text of a configuration; `name` is its file name or option."""

    name: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ConfigLocation:
    """`width` characters at `line` and `column` (both from 1) of a text."""

    text: ConfigText
    line: int
    column: int
    width: int = 1

    @property
    def excerpt(self) -> str:
        """The line of the location; empty after the end of the text."""
        lines = self.text.lines
        return lines[self.line - 1] if self.line <= len(lines) else ""


@dataclass(frozen=True, slots=True)
class ConfigFinding:
    """One problem. `label` is shown beside the carets, `help` suggests a fix."""

    place: ConfigLocation
    message: str
    label: str = ""
    help: str = ""

    def __str__(self) -> str:
        place = self.place
        lines = [
            f"error: {self.message}",
            f"  --> {place.text.name}:{place.line}:{place.column}",
        ]
        if place.excerpt:
            lines += _excerpt(place, self.label)
        elif self.label:
            lines.append(f"note: {self.label}")
        if self.help:
            lines.append(f"help: {self.help}")
        return "\n".join(lines)


def _excerpt(place: ConfigLocation, label: str) -> list[str]:
    """The line, cut to the width of a terminal, with carets below."""
    cut = max(0, place.column - 1 - 80)
    shown = place.excerpt[cut : cut + 160].replace("\t", " ")
    carets = "^" * max(1, min(place.width, len(shown) - (place.column - 1 - cut)))
    number = str(place.line)
    margin = " " * len(number)
    indent = " " * (place.column - 1 - cut)
    return [
        f" {margin} |",
        f" {number} | {shown}",
        f" {margin} | {indent}{carets} {label}".rstrip(),
    ]


class ConfigError(Exception):
    """An invalid configuration; `findings` lists all problems."""

    def __init__(self, findings: Iterable[ConfigFinding]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n\n".join(str(finding) for finding in self.findings))


class ParameterRejected(Exception):
    """A live change was rejected. Raised by `will_set` hooks and by `Parameters.set`."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The label ``did you mean `x`?``, or an empty string."""
    names = list(known)
    lowered = {name.lower(): name for name in reversed(names)}
    near = get_close_matches(word.lower(), lowered, n=1, cutoff=0.6)
    return f"did you mean `{lowered[near[0]]}`?" if near else ""

"""Finds the elements of an array in TOML, because `tomllib` keeps no locations.

In: the place of an array. Out: the places of its elements, also over several lines.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.finding import Location

_TOKEN = re.compile(
    r"""\s+|\#.*|(?P<comma>,)|(?P<open>[\[{])|(?P<close>[\]}])"""
    r"""|"(?:[^"\\]|\\.)*"|'[^']*'|[^\s,\[\]{}\#"']+|."""
)


def element_places(array: Location) -> Iterator[Location]:
    """The place of each element of the array that begins at `array`."""
    depth = 0
    starts = True
    for place, match in _tokens(array):
        if match["close"]:
            depth -= 1
            if not depth:
                return
        elif match["comma"]:
            starts = starts or depth == 1
        elif match[0][0] not in " \t#":
            if depth == 1 and starts:
                yield place
                starts = False
            depth += bool(match["open"])
            if not depth:  # no array
                return


def _tokens(array: Location) -> Iterator[tuple[Location, re.Match[str]]]:
    lines = array.text.lines
    for number in range(array.line, len(lines) + 1):
        first = array.column - 1 if number == array.line else 0
        for match in _TOKEN.finditer(lines[number - 1], first):
            width = max(1, len(match[0]))
            yield Location(array.text, number, match.start() + 1, width), match

"""Reads TOML into a tree with locations.

In: a text. Out: its root mapping and the findings. `tomllib` keeps no locations, so keys are
searched in the text: exact for one key per line, otherwise the nearest line above.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator
from typing import Any

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.toml_arrays import element_places
from robocomp_dsl.runtime.parameters.tree import Items, Mapping, Member, Node, Scalar, TextSyntax

_PART = r"""(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')"""
_NAME = rf"{_PART}(?:\s*\.\s*{_PART})*"
_HEADER = re.compile(rf"\s*\[(\[)?\s*({_NAME})\s*\]")
_KEY = re.compile(rf"\s*({_NAME})\s*=\s*")
_MESSAGE = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", re.DOTALL)


def read_toml(text: SourceText, source: str, findings: list[Finding]) -> Mapping | None:
    """The root mapping of `source`; None if it is not TOML. Adds to `findings`."""
    root = Location(text, 1, 1)
    try:
        data = tomllib.loads(source)
    except tomllib.TOMLDecodeError as error:
        findings.append(_syntax_error(text, error))
        return None
    except ValueError:
        # `int` limits the number of digits: tomllib does not locate this error.
        findings.append(_long_number(text))
        return None
    except RecursionError:
        findings.append(Finding(root, "the file is nested too deeply"))
        return None
    return Mapping(root, _members(data, "", dict(_places(text)), root))


def _long_number(text: SourceText) -> Finding:
    limit = sys.get_int_max_str_digits()
    for number, line in enumerate(text.lines, start=1):
        if match := re.search(rf"[0-9](?:_?[0-9]){{{limit},}}", line):
            place = Location(text, number, match.start() + 1, len(match[0]))
            digits = len(match[0].replace("_", ""))
            return Finding(place, f"this number has {digits} digits; the limit is {limit}")
    return Finding(Location(text, 1, 1), f"a number has more than {limit} digits")


def _syntax_error(text: SourceText, error: tomllib.TOMLDecodeError) -> Finding:
    match = _MESSAGE.fullmatch(str(error))
    reason, line, column = match.groups() if match else (str(error), None, None)
    at = (int(line), int(column)) if line and column else (max(1, len(text.lines)), 1)
    return Finding(Location(text, *at), f"this is not TOML: {reason[:1].lower()}{reason[1:]}")


def _places(text: SourceText) -> Iterator[tuple[str, tuple[Location, Location]]]:
    """Path of every key at the start of a line, with the locations of key and value."""
    prefix = ""
    counts: dict[str, int] = {}
    for number, line in enumerate(text.lines, start=1):
        if header := _HEADER.match(line):
            prefix = _resolve(_dotted(header[2]), counts)
            if header[1]:
                counts[prefix] = counts.get(prefix, -1) + 1
                prefix = f"{prefix}[{counts[prefix]}]"
            place = Location(text, number, header.start(2) + 1, len(header[2]))
            yield prefix, (place, place)
        elif key := _KEY.match(line):
            path = f"{prefix}.{_dotted(key[1])}" if prefix else _dotted(key[1])
            width = len(line[key.end() :].split("#")[0].rstrip())
            value = Location(text, number, key.end() + 1, max(1, width))
            yield path, (Location(text, number, key.start(1) + 1, len(key[1])), value)


def _dotted(name: str) -> str:
    return ".".join(part.strip("\"' \t") for part in re.findall(_PART, name))


def _resolve(path: str, counts: dict[str, int]) -> str:
    """`a.b` below the newest element of the table array `a`: `a[2].b`."""
    for array, last in counts.items():
        if path.startswith(f"{array}."):
            return f"{array}[{last}]{path[len(array) :]}"
    return path


def _members(
    data: dict[str, Any],
    path: str,
    places: dict[str, tuple[Location, Location]],
    above: Location,
) -> dict[str, Member]:
    members = {}
    for name, value in data.items():
        below = f"{path}.{name}" if path else name
        key_place, value_place = places.get(below, (above, above))
        members[name] = Member(key_place, _node(value, below, places, value_place))
    return members


def _node(
    value: Any,
    path: str,
    places: dict[str, tuple[Location, Location]],
    place: Location,
) -> Node:
    match value:
        case dict():
            return Mapping(place, _members(value, path, places, place))
        case list():
            below = [f"{path}[{i}]" for i in range(len(value))]
            found = list(element_places(place))
            inside = found if len(found) == len(value) else [place] * len(value)
            here = [places.get(e, (p, p))[1] for e, p in zip(below, inside, strict=True)]
            return Items(
                place,
                [_node(v, b, places, p) for v, b, p in zip(value, below, here, strict=True)],
            )
        case str():
            return Scalar(place, value, TextSyntax.QUOTED)
        case bool():
            return Scalar(place, str(value).lower())
    return Scalar(place, str(value))

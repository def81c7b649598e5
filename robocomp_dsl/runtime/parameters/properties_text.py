"""Reads a configuration in RoboComp's text format into a tree with locations.

In: `key = value` lines, as Ice reads them: `#` begins a comment, a backslash escapes `#`, `=` and
itself, values may be quoted, and dots in a key separate groups. Out: the root mapping.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.tree import Mapping, Member, Scalar, TextSyntax

_FIRST_LINE = re.compile(r"(?:\s*(?:#.*)?\n)*\s*[A-Za-z_][\w./-]*[ \t]*=(?!=)")


def is_properties(source: str) -> bool:
    """Whether the first line that is no comment has the form `key = value`."""
    return _FIRST_LINE.match(source) is not None


def read_properties(text: SourceText, source: str, findings: list[Finding]) -> Mapping:
    """The root mapping of `source`. Adds to `findings`. Of a key that is set twice, the last."""
    root = Mapping(Location(text, 1, 1))
    for number, line in enumerate(source.splitlines(), 1):
        code = _without_comment(line)
        key, equals, value = (part.strip() for part in code.partition("="))
        column = len(line) - len(line.lstrip()) + 1
        if not code.strip():
            continue
        place = Location(text, number, column, max(1, len(key)))
        at = line.find("=") + 1
        start = at + len(line[at:]) - len(line[at:].lstrip())
        path = [part for part in key.split(".") if part]
        if not equals or not path:
            findings.append(Finding(place, "a line has the form `key = value`"))
            continue
        start += _unquoted(value) != value
        value_place = Location(text, number, start + 1, max(1, len(_unquoted(value))))
        _insert(root, path, place, Scalar(value_place, _unquoted(value), TextSyntax.RAW))
    return root


def _insert(root: Mapping, path: list[str], key: Location, value: Scalar) -> None:
    """Set a value with the place of its key; a group of the same name takes precedence."""
    group = root
    for part in path[:-1]:
        member = group.members.get(part)
        if member is None or not isinstance(member.value, Mapping):
            member = group.members[part] = Member(key, Mapping(key))
        inner = member.value
        assert isinstance(inner, Mapping)  # noqa: S101 - ensured above
        group = inner
    former = group.members.get(path[-1])
    if former is None or not isinstance(former.value, Mapping):
        group.members[path[-1]] = Member(key, value)


def _without_comment(line: str) -> str:
    return "".join(_characters(line))


def _characters(line: str) -> Iterator[str]:
    """The characters of a line before its comment, without escapes."""
    escaped = False
    for position, character in enumerate(line):
        if escaped:
            escaped = False
        elif character == "\\" and line[position + 1 : position + 2] in ("#", "\\", "="):
            escaped = True
            continue
        elif character == "#":
            return
        yield character


def _unquoted(value: str) -> str:
    inner = value[1:-1]
    return inner if len(value) > 1 and value[0] == value[-1] == '"' and '"' not in inner else value

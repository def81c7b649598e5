"""Reads YAML into a tree with locations, without creating any Python object from tags.

In: a text. Out: its root mapping and the findings. It reads parser events, so a hostile file costs
no more than its length: nesting is limited while reading, an alias is a reference, and tags are
ignored (YAML 1.2 core schema; `<<` merges as in YAML 1.1).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml
from yaml import events
from yaml.error import MarkedYAMLError, YAMLError

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.tree import Items, Mapping, Member, Node, Scalar, TextSyntax

_MAX_DEPTH = 40
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_yaml(text: SourceText, source: str, findings: list[Finding]) -> Mapping | None:
    """The root mapping of `source`; None if it is not YAML. Adds to `findings`."""
    composer = _Composer(text, findings)
    try:
        return composer.document(iter(yaml.parse(source, Loader=_LOADER)))
    except _TooDeep as deep:
        findings.append(Finding(deep.place, "the file is nested too deeply"))
    except MarkedYAMLError as error:
        findings.append(_syntax_error(text, error))
    except YAMLError as error:
        findings.append(_reader_error(text, source, error))
    return None


class _TooDeep(Exception):
    def __init__(self, place: Location) -> None:
        self.place = place


class _Composer:
    """Builds nodes from a text's events (`Any`: PyYAML declares no attributes)."""

    def __init__(self, text: SourceText, findings: list[Finding]) -> None:
        self.text = text
        self.findings = findings
        self.anchors: dict[str, Node] = {}

    def document(self, stream: Iterator[Any]) -> Mapping | None:
        self.stream = stream
        root: Node | None = None
        for event in stream:
            if isinstance(event, events.DocumentStartEvent) and root is not None:
                place = self.place(event.start_mark, 3)
                self.findings.append(
                    Finding(place, "a configuration is one YAML document; a second one starts here")
                )
                break
            if isinstance(event, events.NodeEvent):
                root = self.node(event, 0)
        return self.as_root(root)

    def as_root(self, root: Node | None) -> Mapping | None:
        if isinstance(root, Mapping):
            return Mapping(Location(self.text, 1, 1), root.members)
        if root is not None and not (isinstance(root, Scalar) and root.text == ""):
            self.findings.append(
                Finding(
                    root.place,
                    "a configuration is a group of `key: value` lines",
                    help=_root_help(root),
                )
            )
            return None
        return Mapping(Location(self.text, 1, 1))

    def node(self, event: Any, depth: int) -> Node:
        place = self.place(event.start_mark, _width(event))
        if depth > _MAX_DEPTH:
            raise _TooDeep(place)
        if isinstance(event, events.AliasEvent):
            return self.alias(event.anchor, place)
        if event.tag not in (None, "!", "tag:yaml.org,2002:str"):
            message = (
                f"the tag `{event.tag.replace('tag:yaml.org,2002:', '!!')}` has no meaning here"
            )
            self.findings.append(Finding(place, message, help="remove it"))
        if isinstance(event, events.ScalarEvent):
            plain = event.style in (None, "") and event.tag is None
            node: Node = Scalar(
                place, event.value, TextSyntax.PLAIN if plain else TextSyntax.QUOTED
            )
        elif isinstance(event, events.SequenceStartEvent):
            node = Items(place, self.items(depth))
        else:
            node = self.mapping(place, depth)
        if event.anchor:
            self.anchors[event.anchor] = node
        return node

    def alias(self, name: Any, place: Location) -> Node:
        found = self.anchors.get(name)
        if found is None:
            message = (
                f"the alias `*{name}` stands before the end of its anchor `&{name}`, or has none"
            )
            self.findings.append(Finding(place, message))
            return Scalar(place, "")
        return found

    def items(self, depth: int) -> list[Node]:
        items: list[Node] = []
        while not isinstance(event := next(self.stream), events.SequenceEndEvent):
            items.append(self.node(event, depth + 1))
        return items

    def mapping(self, place: Location, depth: int) -> Mapping:
        members: dict[str, Member] = {}
        merged: list[Node] = []
        while not isinstance(event := next(self.stream), events.MappingEndEvent):
            key = self.node(event, depth + 1)
            value = self.node(next(self.stream), depth + 1)
            if not isinstance(key, Scalar):
                self.findings.append(Finding(key.place, "a key must be a single word"))
            elif key.text == "<<" and key.style is TextSyntax.PLAIN:
                merged += value.items if isinstance(value, Items) else [value]
            elif (earlier := members.get(key.text)) is not None:
                message = f"`{key.text:.60}` is a duplicate key"
                label = f"first defined in line {earlier.place.line}"
                self.findings.append(Finding(key.place, message, label))
            else:
                members[key.text] = Member(key.place, value)
        self.merge(members, merged)
        return Mapping(place, members)

    def merge(self, members: dict[str, Member], merged: list[Node]) -> None:
        for source in merged:
            if not isinstance(source, Mapping):
                self.findings.append(Finding(source.place, "`<<` merges groups only"))
                continue
            for name, member in source.members.items():
                members.setdefault(name, member)

    def place(self, mark: Any, width: int = 1) -> Location:
        return Location(self.text, mark.line + 1, mark.column + 1, width)


def _width(event: Any) -> int:
    start, end = event.start_mark, event.end_mark
    return max(1, end.column - start.column) if end.line == start.line else 1


def _root_help(root: Node) -> str:
    if isinstance(root, Scalar) and "=" in root.text:
        return "write `key: value` for every `key = value`; or name the file `.toml`"
    return "write for instance `rate: 20`"


def _syntax_error(text: SourceText, error: MarkedYAMLError) -> Finding:
    mark = error.problem_mark or error.context_mark
    reason = error.problem or error.context or "it cannot be parsed"
    place = Location(text, mark.line + 1, mark.column + 1) if mark else Location(text, 1, 1)
    way_out = "indent with spaces, YAML takes no tabs" if "\t" in place.excerpt else ""
    label = ""
    if error.context and error.context_mark and error.context_mark.line != place.line - 1:
        label = f"{error.context}, which begins in line {error.context_mark.line + 1}"
    return Finding(place, f"this is not YAML: {reason}", label, way_out)


def _reader_error(text: SourceText, source: str, error: YAMLError) -> Finding:
    offset = min(getattr(error, "position", 0) or 0, len(source))
    before = source[:offset]
    place = Location(text, before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1)
    return Finding(place, f"this is not YAML: {getattr(error, 'reason', None) or error}")

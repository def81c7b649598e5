"""YAML to a tree with places, without building any Python object on the way.

In: a text. Out: its root mapping and the findings. Reads parser events, so that a hostile file
costs no more than its length: nesting is bounded while reading, an alias is a reference, and no
tag ever makes an object (YAML 1.2 core schema; `<<` merges as in YAML 1.1).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml
from yaml import events
from yaml.error import MarkedYAMLError, YAMLError

from robocomp_dsl.runtime.parameters.findings import Finding, Place, Text
from robocomp_dsl.runtime.parameters.tree import Items, Mapping, Member, Node, Scalar, Style

_DEEPEST = 40
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_yaml(text: Text, source: str, findings: list[Finding]) -> Mapping | None:
    """The root mapping of `source`; None when it is not YAML. Adds to `findings`."""
    composer = _Composer(text, findings)
    try:
        return composer.document(iter(yaml.parse(source, Loader=_LOADER)))
    except _TooDeep as deep:
        findings.append(Finding(deep.place, "the file is nested too deeply"))
    except MarkedYAMLError as error:
        findings.append(_syntax(text, error))
    except YAMLError as error:
        findings.append(_unacceptable(text, source, error))
    return None


class _TooDeep(Exception):
    def __init__(self, place: Place) -> None:
        self.place = place


class _Composer:
    """Makes nodes of the events of one text (events are `Any`: PyYAML declares no attributes)."""

    def __init__(self, text: Text, findings: list[Finding]) -> None:
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
                    Finding(place, "a configuration is one YAML document, a second begins here")
                )
                break
            if isinstance(event, events.NodeEvent):
                root = self.node(event, 0)
        return self.as_root(root)

    def as_root(self, root: Node | None) -> Mapping | None:
        if isinstance(root, Mapping):
            return Mapping(Place(self.text, 1, 1), root.members)
        if root is not None and not (isinstance(root, Scalar) and root.text == ""):
            self.findings.append(
                Finding(
                    root.place,
                    "a configuration is a group of `key: value` lines",
                    help=_form_help(root),
                )
            )
            return None
        return Mapping(Place(self.text, 1, 1))

    def node(self, event: Any, depth: int) -> Node:
        place = self.place(event.start_mark, _width(event))
        if depth > _DEEPEST:
            raise _TooDeep(place)
        if isinstance(event, events.AliasEvent):
            return self.alias(event.anchor, place)
        if event.tag not in (None, "!", "tag:yaml.org,2002:str"):
            said = f"the tag `{event.tag.replace('tag:yaml.org,2002:', '!!')}` has no meaning here"
            self.findings.append(Finding(place, said, help="remove it"))
        if isinstance(event, events.ScalarEvent):
            plain = event.style in (None, "") and event.tag is None
            made: Node = Scalar(place, event.value, Style.PLAIN if plain else Style.QUOTED)
        elif isinstance(event, events.SequenceStartEvent):
            made = Items(place, self.items(depth))
        else:
            made = self.mapping(place, depth)
        if event.anchor:
            self.anchors[event.anchor] = made
        return made

    def alias(self, name: Any, place: Place) -> Node:
        found = self.anchors.get(name)
        if found is None:
            said = f"the alias `*{name}` stands before the end of its anchor `&{name}`, or has none"
            self.findings.append(Finding(place, said))
            return Scalar(place, "")
        return found

    def items(self, depth: int) -> list[Node]:
        made: list[Node] = []
        while not isinstance(event := next(self.stream), events.SequenceEndEvent):
            made.append(self.node(event, depth + 1))
        return made

    def mapping(self, place: Place, depth: int) -> Mapping:
        members: dict[str, Member] = {}
        merged: list[Node] = []
        while not isinstance(event := next(self.stream), events.MappingEndEvent):
            key = self.node(event, depth + 1)
            value = self.node(next(self.stream), depth + 1)
            if not isinstance(key, Scalar):
                self.findings.append(Finding(key.place, "a key must be a single word"))
            elif key.text == "<<" and key.style is Style.PLAIN:
                merged += value.items if isinstance(value, Items) else [value]
            elif (earlier := members.get(key.text)) is not None:
                said = f"`{key.text:.60}` is given twice"
                label = f"given before in line {earlier.place.line}"
                self.findings.append(Finding(key.place, said, label))
            else:
                members[key.text] = Member(key.place, value)
        self.merge(members, merged)
        return Mapping(place, members)

    def merge(self, members: dict[str, Member], merged: list[Node]) -> None:
        for one in merged:
            if not isinstance(one, Mapping):
                self.findings.append(Finding(one.place, "`<<` merges groups only"))
                continue
            for name, member in one.members.items():
                members.setdefault(name, member)

    def place(self, mark: Any, width: int = 1) -> Place:
        return Place(self.text, mark.line + 1, mark.column + 1, width)


def _width(event: Any) -> int:
    start, end = event.start_mark, event.end_mark
    return max(1, end.column - start.column) if end.line == start.line else 1


def _form_help(root: Node) -> str:
    if isinstance(root, Scalar) and "=" in root.text:
        return "write `key: value` for every `key = value`; or name the file `.toml`"
    return "write for instance `rate: 20`"


def _syntax(text: Text, error: MarkedYAMLError) -> Finding:
    mark = error.problem_mark or error.context_mark
    said = error.problem or error.context or "it cannot be parsed"
    place = Place(text, mark.line + 1, mark.column + 1) if mark else Place(text, 1, 1)
    way_out = "indent with spaces, YAML takes no tabs" if "\t" in place.excerpt else ""
    label = ""
    if error.context and error.context_mark and error.context_mark.line != place.line - 1:
        label = f"{error.context}, which begins in line {error.context_mark.line + 1}"
    return Finding(place, f"this is not YAML: {said}", label, way_out)


def _unacceptable(text: Text, source: str, error: YAMLError) -> Finding:
    offset = min(getattr(error, "position", 0) or 0, len(source))
    before = source[:offset]
    place = Place(text, before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1)
    return Finding(place, f"this is not YAML: {getattr(error, 'reason', None) or error}")

"""Checks a configuration tree against a schema, and reports every problem.

In: the root mapping and the schema. Out: the values by name (groups as dictionaries, lists of
groups as lists of them); complete only if no finding was added.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.finding import Finding, Location
from robocomp_dsl.runtime.parameters import overrides, value_list
from robocomp_dsl.runtime.parameters import scalar as scalars
from robocomp_dsl.runtime.parameters.errors import did_you_mean
from robocomp_dsl.runtime.parameters.scalar import InvalidValue
from robocomp_dsl.runtime.parameters.schema import (
    KIND_NAMES,
    Element,
    Entry,
    Group,
    Parameter,
    Schema,
)
from robocomp_dsl.runtime.parameters.tree import NODE_NAMES, Items, Mapping, Member, Node, Scalar

_MOST_NODES = 100_000
_MOST_FINDINGS = 100


def check_values(root: Mapping, schema: Schema, findings: list[Finding]) -> dict[str, Any]:
    """The value of every parameter of `schema`. Adds to `findings`, at most 100 in all."""
    checker = _Checker(findings)
    try:
        return checker.group(root, schema, "")
    except _TooManyFindings as enough:
        findings.append(Finding(enough.place, str(enough)))
        return {}


class _TooManyFindings(Exception):
    def __init__(self, place: Location, message: str) -> None:
        self.place = place
        super().__init__(message)


class _Checker:
    """Walks a tree along its schema. It limits the entries: aliases can make a short file huge."""

    def __init__(self, findings: list[Finding]) -> None:
        self.findings = findings
        self.visited = 0

    def add(self, place: Location, message: str, label: str = "", help: str = "") -> None:
        if len(self.findings) >= _MOST_FINDINGS:
            raise _TooManyFindings(place, "too many errors, the rest is not shown")
        self.findings.append(Finding(place, message, label, help))

    def group(self, found: Mapping, schema: Schema, prefix: str) -> dict[str, Any]:
        known = {entry.name: entry for entry in schema}
        for name, member in found.members.items():
            if name not in known:
                self.unknown(name, member, known, prefix)
        values = {}
        for name, entry in known.items():
            self.visited += 1
            if self.visited > _MOST_NODES:
                raise _TooManyFindings(found.place, "the configuration has too many entries")
            entry_value = found.members.get(name)
            path = f"{prefix}.{name}" if prefix else name
            if entry_value is None:
                values[name] = self.absent(found, entry, path)
            elif isinstance(entry, Parameter):
                values[name] = self.parameter(entry_value.value, entry, path)
            elif entry.single:
                values[name] = self.single(entry_value.value, entry, path)
            else:
                values[name] = self.list_of(entry_value.value, entry, path)
        return values

    def unknown(self, name: str, member: Member, known: dict[str, Entry], prefix: str) -> None:
        label = did_you_mean(name, known)
        listed = f"known: {', '.join(known):.300}" if known else "no parameters are defined here"
        shown = f"parameter `{name:.80}`"
        message = f"`{prefix}` has no {shown}" if prefix else f"unknown {shown}"
        self.add(member.place, message, label, "" if label else listed)

    def absent(self, owner: Mapping, entry: Entry, path: str) -> Any:
        if isinstance(entry, Parameter):
            if entry.default is None:
                message = f"`{path}` is not given and has no default"
                self.add(owner.place, message, help=f"add `{_sample(entry)}`")
            return list(entry.default) if isinstance(entry.default, tuple) else entry.default
        if entry.single:
            return self.group(Mapping(owner.place), entry.type.SCHEMA, path)
        if entry.low:
            message = f"`{path}` is not given, it must have {_entries(entry)}"
            self.add(owner.place, message, help=f"add `{entry.name}:` and its entries below it")
        return []

    def parameter(self, node: Node, entry: Parameter, path: str) -> Any:
        if entry.is_list:
            return self.values(node, entry, path)
        if not isinstance(node, Scalar):
            message = f"`{path}` must be {KIND_NAMES[entry.kind]}, not {NODE_NAMES[type(node)]}"
            self.add(node.place, message, f"expected {entry.kind}")
            return None
        try:
            return scalars.from_scalar(entry, path, node)
        except InvalidValue as unfit:
            self.add(node.place, str(unfit), unfit.label, unfit.help)
            return None

    def values(self, node: Node, entry: Parameter, path: str) -> list[Element]:
        self.visited += len(node.items) if isinstance(node, Items) else 0
        values, problems = value_list.from_node(entry, path, node)
        for place, unfit in problems:
            self.add(place, str(unfit), unfit.label, unfit.help)
        return values

    def single(self, node: Node, entry: Group, path: str) -> Any:
        if isinstance(node, Mapping):
            return self.group(node, entry.type.SCHEMA, path)
        message = f"`{path}` must be a group of `key: value` lines, not {NODE_NAMES[type(node)]}"
        self.add(node.place, message)
        return {}

    def list_of(self, node: Node, entry: Group, path: str) -> list[Any]:
        if not isinstance(node, Items):
            message = f"`{path}` must be a list, not {NODE_NAMES[type(node)]}"
            way_out = f"begin each of the {entry.name} with `- `"
            if node.place.file == overrides.SOURCE_NAME:
                way_out = f"set a member of one of them, as in `--set {path}[0].…`"
            self.add(node.place, message, help=way_out)
            return []
        count = len(node.items)
        if count < (entry.low or 0) or (entry.high is not None and count > entry.high):
            self.add(node.place, f"`{path}` has {count} entries, it must have {_entries(entry)}")
        return [self.single(item, entry, f"{path}[{i}]") for i, item in enumerate(node.items)]


def _entries(entry: Group) -> str:
    low, high = entry.low or 0, entry.high
    if high is None:
        return f"{low} or more"
    return f"{low}" if low == high else f"{low} to {high}"


def _sample(entry: Parameter) -> str:
    unit = f" [{entry.unit}]" if entry.unit else ""
    value = "|".join(entry.choices) if entry.choices else f"<{entry.kind}{unit}>"
    return f"{entry.name}: [{value}, …]" if entry.is_list else f"{entry.name}: {value}"

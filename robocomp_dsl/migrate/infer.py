"""From all configurations of a component to its parameters.

In: the entries of every file that are parameters. Out: a tree of `Leaf`, `Branch` and `Listed`,
and for each file its values. Dotted keys become nested groups.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.config import Config, Entry, Value
from robocomp_dsl.migrate.values import as_kind, as_text, joined, kind_of, looks_like_list
from robocomp_dsl.model.parameter import Kind
from robocomp_dsl.model.types import Literal

ITEM = "value"
"""The one parameter of the groups that a list of plain values becomes."""

_NAME = re.compile(r"(?!(?:string|int|float|bool)$)[A-Za-z_][A-Za-z0-9_]*", re.IGNORECASE)
"""What a parameter can be called; the names of types are keywords of PDSL."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """One value. `texts` are what the first file had for true and false, if it is a bool."""

    name: str
    old: tuple[str, ...]
    kind: Kind
    default: Literal | None
    doc: str = ""
    texts: tuple[str, str] = ("true", "false")


@dataclass(frozen=True, slots=True)
class Branch:
    """A group of parameters."""

    name: str
    members: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Listed:
    """A list of groups with one `value` each, from a list of plain values."""

    name: str
    old: tuple[str, ...]
    item: Leaf
    doc: str = ""


MOST_LISTED = 5
"""So many missing keys of a file are named."""

Node: TypeAlias = Leaf | Branch | Listed
Tree: TypeAlias = tuple[Node, ...]

Values: TypeAlias = dict[tuple[str, ...], Literal | list[Literal]]
"""By the path of the parameter, in new names."""


@dataclass(frozen=True, slots=True)
class Parameters:
    """What a component's configurations hold: the parameters, and the values of each file.

    `typed`: the first file is TOML.
    """

    tree: Tree
    values: tuple[Values, ...]
    typed: bool


@dataclass(slots=True)
class _Given:
    """One key in all files: `entries` by the number of the file."""

    entries: dict[int, Entry] = field(default_factory=dict)
    below: dict[str, _Given] = field(default_factory=dict)


def infer(configs: Sequence[tuple[Config, Sequence[Entry]]], report: Report) -> Parameters:
    """The parameters of all `configs`, of which the first one gives the defaults."""
    root = _Given()
    for number, (_, entries) in enumerate(configs):
        for one in entries:
            at = root
            for part in one.path:
                at = at.below.setdefault(part, _Given())
            at.entries[number] = one
    builder = _Builder([config for config, _ in configs], report)
    tree = tuple(builder.members(root, ()))
    builder.tell_missing()
    return Parameters(tree, tuple(builder.values), bool(configs) and configs[0][0].typed)


class _Builder:
    """Makes the nodes, and fills the values of every file meanwhile."""

    def __init__(self, configs: Sequence[Config], report: Report) -> None:
        self.configs = configs
        self.report = report
        self.values: list[Values] = [{} for _ in configs]
        self.missing: list[list[Entry]] = [[] for _ in configs]

    def members(self, given: _Given, path: tuple[str, ...]) -> Iterator[Node]:
        taken: set[str] = set()
        # Names that need no change keep theirs, whichever file has them.
        for old, one in sorted(given.below.items(), key=lambda i: not _NAME.fullmatch(i[0])):
            name = _claimed(old, taken)
            if name != old:
                self.tell_renamed(one, old, name)
            yield from self.node(one, (*path, name))

    def node(self, given: _Given, path: tuple[str, ...]) -> Iterator[Node]:
        """What one key became; a value beside keys below it is told and left out."""
        if given.below:
            for entry in given.entries.values():
                below = next(_entries(given.below))
                self.clash(entry, "a value", below, "a group")
            if members := tuple(self.members(given, path)):
                yield Branch(path[-1], members)
            return
        self.look_for_missing(given)
        first = next(iter(given.entries.values()))
        is_list = _is_plain_list(first.value)
        fitting = {}
        for number, entry in given.entries.items():
            if _is_plain_list(entry.value) is is_list:
                fitting[number] = entry
            else:
                words = ("a value", "a list") if is_list else ("a list", "a value")
                self.clash(entry, words[0], first, words[1])
        make = self.listed if is_list else self.leaf
        yield make(fitting, path)

    def leaf(self, given: Mapping[int, Entry], path: tuple[str, ...]) -> Leaf:
        kinds = {n: kind_of(e.value, typed=self.configs[n].typed) for n, e in given.items()}
        kind = joined(kinds.values())
        for number, entry in given.items():
            self.values[number][path] = as_kind(entry.value, kind)
            self.tell_text(entry, kind, kinds[number])
        first = next(iter(given))
        entry = given[first]
        doc = next((e.doc for e in given.values() if e.doc), "")
        texts = _bool_texts(entry.value) if kind is Kind.BOOL else ("true", "false")
        default = as_kind(entry.value, kind)
        return Leaf(path[-1], entry.path, kind, default, doc, texts)

    def listed(self, given: Mapping[int, Entry], path: tuple[str, ...]) -> Listed:
        kinds = [kind_of(v, typed=True) for e in given.values() for v in e.value]
        kind = joined(kinds) if kinds else Kind.STRING
        for number, entry in given.items():
            self.values[number][path] = [as_kind(v, kind) for v in entry.value]
            if kind is Kind.STRING and any(not isinstance(v, str) for v in entry.value):
                said = f"the items of `{entry.key}` are of different kinds, so they became texts"
                self.report.add(codes.NOT_SUPPORTED_VALUE, entry.span, said)
        entry = next(iter(given.values()))
        doc = next((e.doc for e in given.values() if e.doc), "")
        return Listed(path[-1], entry.path, Leaf(ITEM, entry.path, kind, None), doc)

    def tell_text(self, entry: Entry, kind: Kind, own: Kind) -> None:
        """What a reader should know of a value that is a text now."""
        if kind is not Kind.STRING:
            return
        if own is not kind:
            said = f"`{entry.key}` is a text, because another file gives it one"
            self.report.add(codes.NOT_SUPPORTED_VALUE, entry.span, said)
        elif not isinstance(entry.value, str):
            said = f"`{entry.key}` became the text `{as_text(entry.value):.60}`"
            self.report.add(codes.NOT_SUPPORTED_VALUE, entry.span, said)
        elif looks_like_list(entry.value):
            said = f"`{entry.key}` looks like a list and stays a text"
            self.report.add(codes.TEXT_LIST, entry.span, said)

    def tell_renamed(self, given: _Given, old: str, name: str) -> None:
        for entry in list(_entries({old: given}))[:1]:
            said = f"`{old:.60}` in `{entry.key:.80}` is called `{name:.60}` now"
            self.report.add(codes.RENAMED_KEY, entry.span, said)

    def look_for_missing(self, given: _Given) -> None:
        entry = next(iter(given.entries.values()))
        for number, missing in enumerate(self.missing):
            if number not in given.entries:
                missing.append(entry)

    def tell_missing(self) -> None:
        """One finding for each file, whatever it lacks."""
        for config, missing in zip(self.configs, self.missing, strict=True):
            if missing:
                names = [f"`{one.key}`" for one in missing]
                listed = ", ".join(names[:MOST_LISTED])
                more = f" and {len(names) - MOST_LISTED} more" if len(names) > MOST_LISTED else ""
                have = "they have their defaults" if len(names) > 1 else "it has its default"
                said = f"`{config.path.name}` does not give {listed}{more}; {have} there"
                notes = [Note(one.span, f"`{one.key}` comes from here") for one in missing]
                self.report.add(
                    codes.MISSING_KEY, config.source.whole, said, notes=notes[:MOST_LISTED]
                )

    def clash(self, entry: Entry, what: str, other: Entry, is_: str) -> None:
        said = f"`{entry.key}` is {what} here and {is_} elsewhere; it was left out"
        note = Note(other.span, f"{is_} here")
        self.report.add(codes.CONFIG_CLASH, entry.span, said, notes=(note,))


def _entries(given: Mapping[str, _Given]) -> Iterator[Entry]:
    """All entries at and below some keys."""
    for one in given.values():
        yield from one.entries.values()
        yield from _entries(one.below)


def _claimed(old: str, taken: set[str]) -> str:
    name = re.sub(r"[^A-Za-z0-9_]", "_", old) or "_"
    name = f"_{name}" if name[0].isdigit() else name
    while name in taken or not _NAME.fullmatch(name):
        name += "_"
    taken.add(name)
    return name


def _is_plain_list(value: Value) -> bool:
    """Whether a value is a list of single values, which a list of groups can hold."""
    return isinstance(value, list) and not any(isinstance(v, list | dict) for v in value)


def _bool_texts(value: Value) -> tuple[str, str]:
    """How a file writes true and false, from one of them."""
    if not isinstance(value, str):
        return ("true", "false")
    if value.isupper():
        return ("TRUE", "FALSE")
    return ("True", "False") if value[:1].isupper() else ("true", "false")

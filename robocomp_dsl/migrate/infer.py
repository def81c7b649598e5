"""Infer the parameters of a component from its configurations.

In: the entries of every file that are parameters. Out: a tree of `ScalarParameter`,
`ParameterGroup` and `ListParameter`, and the values of each file. Dotted keys become nested groups.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.config import Config, ConfigEntry, Value
from robocomp_dsl.migrate.values import (
    common_kind,
    convert_value,
    format_value,
    kind_of,
    looks_like_list,
    usual_text,
)
from robocomp_dsl.model.parameter import Kind
from robocomp_dsl.model.types import Literal

"""The parameter of each group that replaces an item of a plain list."""

_NAME = re.compile(r"(?!(?:string|int|float|bool)$)[A-Za-z_][A-Za-z0-9_]*", re.IGNORECASE)
"""Valid parameter names; the names of types are keywords of PDSL."""


@dataclass(frozen=True, slots=True)
class ScalarParameter:
    """One value. `texts` are the spellings of values in text files that differ from the usual."""

    name: str
    old_path: tuple[str, ...]
    kind: Kind
    default: Literal | None
    doc: str = ""
    texts: Mapping[Literal, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class InferredGroup:
    """A group of parameters."""

    name: str
    members: tuple[ParameterNode, ...]


@dataclass(frozen=True, slots=True)
class ListParameter:
    """A list of plain values of one kind."""

    name: str
    old_path: tuple[str, ...]
    kind: Kind
    doc: str = ""


MAX_NAMED_KEYS = 5
"""At most this many missing keys of a file are listed."""

ParameterNode: TypeAlias = ScalarParameter | InferredGroup | ListParameter
ParameterTree: TypeAlias = tuple[ParameterNode, ...]

ParameterValues: TypeAlias = dict[tuple[str, ...], Literal | list[Literal]]
"""Values by the path of the parameter, in new names."""


@dataclass(frozen=True, slots=True)
class InferredParameters:
    """The parameters of a component, and the values of each configuration.

    `typed` is true if the first file is TOML.
    """

    tree: ParameterTree
    values: tuple[ParameterValues, ...]
    typed: bool


@dataclass(slots=True)
class _KeyOccurrences:
    """One key in all files; `entries` is by the index of the file."""

    entries: dict[int, ConfigEntry] = field(default_factory=dict)
    children: dict[str, _KeyOccurrences] = field(default_factory=dict)


def infer(
    configs: Sequence[tuple[Config, Sequence[ConfigEntry]]], report: Report
) -> InferredParameters:
    """The parameters of all `configs`; the first one provides the defaults."""
    root = _KeyOccurrences()
    for number, (_, entries) in enumerate(configs):
        for entry in entries:
            occurrences = root
            for part in entry.path:
                occurrences = occurrences.children.setdefault(part, _KeyOccurrences())
            occurrences.entries[number] = entry
    builder = _TreeBuilder([config for config, _ in configs], report)
    tree = tuple(builder.members(root, ()))
    builder.report_missing()
    return InferredParameters(tree, tuple(builder.values), bool(configs) and configs[0][0].typed)


class _TreeBuilder:
    """Builds the parameter nodes and collects the values of every file."""

    def __init__(self, configs: Sequence[Config], report: Report) -> None:
        self.configs = configs
        self.report = report
        self.values: list[ParameterValues] = [{} for _ in configs]
        self.missing: list[list[ConfigEntry]] = [[] for _ in configs]

    def members(
        self, occurrences: _KeyOccurrences, path: tuple[str, ...]
    ) -> Iterator[ParameterNode]:
        taken: set[str] = set()
        # Valid names are claimed first, so that they stay unchanged.
        for old, child in sorted(
            occurrences.children.items(), key=lambda i: not _NAME.fullmatch(i[0])
        ):
            name = _unique_name(old, taken)
            if name != old:
                self.report_renamed(child, old, name)
            yield from self.node(child, (*path, name))

    def node(self, occurrences: _KeyOccurrences, path: tuple[str, ...]) -> Iterator[ParameterNode]:
        """The parameter of one key; a key that is both value and group is reported."""
        if occurrences.children:
            for entry in occurrences.entries.values():
                below = next(_entries(occurrences.children))
                self.report_clash(entry, "a value", below, "a group")
            if members := tuple(self.members(occurrences, path)):
                yield InferredGroup(path[-1], members)
            return
        self.record_missing(occurrences)
        first = next(iter(occurrences.entries.values()))
        is_list = _is_plain_list(first.value)
        fitting = {}
        for number, entry in occurrences.entries.items():
            if _is_plain_list(entry.value) is is_list:
                fitting[number] = entry
            else:
                words = ("a value", "a list") if is_list else ("a list", "a value")
                self.report_clash(entry, words[0], first, words[1])
        make = self.list_parameter if is_list else self.scalar
        yield make(fitting, path)

    def scalar(
        self, occurrences: Mapping[int, ConfigEntry], path: tuple[str, ...]
    ) -> ScalarParameter:
        kinds = {n: kind_of(e.value, typed=self.configs[n].typed) for n, e in occurrences.items()}
        kind = common_kind(kinds.values())
        for number, entry in occurrences.items():
            self.values[number][path] = convert_value(entry.value, kind)
            self.report_string(entry, kind, kinds[number])
        first = next(iter(occurrences))
        entry = occurrences[first]
        doc = next((e.doc for e in occurrences.values() if e.doc), "")
        texts = _texts([e.value for e in occurrences.values()], kind)
        default = convert_value(entry.value, kind)
        return ScalarParameter(path[-1], entry.path, kind, default, doc, texts)

    def list_parameter(
        self, occurrences: Mapping[int, ConfigEntry], path: tuple[str, ...]
    ) -> ListParameter:
        kinds = [kind_of(v, typed=True) for e in occurrences.values() for v in e.value]
        kind = common_kind(kinds) if kinds else Kind.STRING
        for number, entry in occurrences.items():
            self.values[number][path] = [convert_value(v, kind) for v in entry.value]
            if kind is Kind.STRING and any(not isinstance(v, str) for v in entry.value):
                message = f"the items of `{entry.key}` are of different types; they became strings"
                self.report.add(codes.CONVERTED_TO_STRING, entry.span, message)
        entry = next(iter(occurrences.values()))
        doc = next((e.doc for e in occurrences.values() if e.doc), "")
        return ListParameter(path[-1], entry.path, kind, doc)

    def report_string(self, entry: ConfigEntry, kind: Kind, own: Kind) -> None:
        """Report a value that became a string."""
        if kind is not Kind.STRING:
            return
        if own is not kind:
            message = f"`{entry.key}` became a string, because another file has a string"
            self.report.add(codes.CONVERTED_TO_STRING, entry.span, message)
        elif not isinstance(entry.value, str):
            message = f"`{entry.key}` became the string `{format_value(entry.value):.60}`"
            self.report.add(codes.CONVERTED_TO_STRING, entry.span, message)
        elif looks_like_list(entry.value):
            message = f"`{entry.key}` looks like a list; it stays a string"
            self.report.add(codes.LIST_IN_STRING, entry.span, message)

    def report_renamed(self, occurrences: _KeyOccurrences, old: str, name: str) -> None:
        for entry in list(_entries({old: occurrences}))[:1]:
            message = f"`{old:.60}` in `{entry.key:.80}` was renamed to `{name:.60}`"
            self.report.add(codes.RENAMED_KEY, entry.span, message)

    def record_missing(self, occurrences: _KeyOccurrences) -> None:
        entry = next(iter(occurrences.entries.values()))
        for number, missing in enumerate(self.missing):
            if number not in occurrences.entries:
                missing.append(entry)

    def report_missing(self) -> None:
        """Report the missing keys of each file in one finding."""
        for config, missing in zip(self.configs, self.missing, strict=True):
            if missing:
                names = [f"`{entry.key}`" for entry in missing]
                listed = ", ".join(names[:MAX_NAMED_KEYS])
                more = (
                    f" and {len(names) - MAX_NAMED_KEYS} more"
                    if len(names) > MAX_NAMED_KEYS
                    else ""
                )
                have = "their defaults apply" if len(names) > 1 else "its default applies"
                message = f"`{config.path.name}` lacks {listed}{more}; {have}"
                notes = [Note(entry.span, f"`{entry.key}` comes from here") for entry in missing]
                self.report.add(
                    codes.MISSING_KEY,
                    config.source.file_span,
                    message,
                    notes=notes[:MAX_NAMED_KEYS],
                )

    def report_clash(
        self, entry: ConfigEntry, form: str, other: ConfigEntry, other_form: str
    ) -> None:
        message = f"`{entry.key}` is {form} here and {other_form} elsewhere; it was left out"
        note = Note(other.span, f"{other_form} here")
        self.report.add(codes.CONFLICTING_KEY, entry.span, message, notes=(note,))


def _entries(occurrences: Mapping[str, _KeyOccurrences]) -> Iterator[ConfigEntry]:
    """All entries of some keys and of the keys below them."""
    for occurrence in occurrences.values():
        yield from occurrence.entries.values()
        yield from _entries(occurrence.children)


def _unique_name(old: str, taken: set[str]) -> str:
    name = re.sub(r"[^A-Za-z0-9_]", "_", old) or "_"
    name = f"_{name}" if name[0].isdigit() else name
    while name in taken or not _NAME.fullmatch(name):
        name += "_"
    taken.add(name)
    return name


def _is_plain_list(value: Value) -> bool:
    """Whether a value is a list without lists and tables in it."""
    return isinstance(value, list) and not any(isinstance(v, list | dict) for v in value)


def _texts(values: Sequence[Value], kind: Kind) -> dict[Literal, str]:
    """The spellings of the values in text files that are not the usual one of the value."""
    texts: dict[Literal, str] = {}
    for spelling in values:
        if not isinstance(spelling, str) or kind is Kind.STRING:
            continue
        value = convert_value(spelling, kind)
        if spelling != usual_text(value):
            texts.setdefault(value, spelling)
    if kind is Kind.BOOL and texts:
        capital = next(iter(texts.values())).istitle()
        for value in (True, False):
            texts.setdefault(value, str(value) if capital else str(value).upper())
    return texts

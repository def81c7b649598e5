"""Values that a user types, as YAML, with the place of each mistake.

In: a text and a type. Out: a value that the codec takes, or a `CliError` with the column, what is
expected there and an example.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import yaml

from robocomp_dsl.cli.program import EXIT_USAGE, CliError
from robocomp_dsl.cli.rcdeploy.inspect.examples import example
from robocomp_dsl.cli.rcdeploy.inspect.type_names import type_name
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.convert import check_count
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    DOUBLE,
    FLOAT,
    Array,
    Dictionary,
    Enum,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import EncodeError

_BOOLS = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
_INFINITE = {".inf": "inf", "+.inf": "inf", "-.inf": "-inf", ".nan": "nan"}
_MAX_FLOAT = float(np.finfo(np.float32).max)
_LOADER: type[Any] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def parse_value(type_: Type, text: str, name: str) -> Any:
    """The value of the parameter `name`, as the codec takes it. Raises `CliError`."""
    reader = _Reader(text, name)
    try:
        node = yaml.compose(text, Loader=_LOADER)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise reader.problem_at(
            mark.line if mark else 0,
            mark.column if mark else 0,
            f"this is not YAML: {error.problem or error.context}",
            type_,
        ) from None
    except (yaml.YAMLError, RecursionError) as error:
        raise reader.problem_at(0, 0, f"this is not YAML: {error}", type_) from None
    if node is None:
        raise reader.problem_at(0, 0, "there is no value", type_)
    try:
        return reader.value(type_, node)
    except RecursionError:
        raise reader.problem_at(0, 0, "the value is nested too deeply", type_) from None


class _Reader:
    """Converts the nodes of one text."""

    def __init__(self, text: str, name: str) -> None:
        self._lines = text.splitlines() or [""]
        self._name = name

    def value(self, type_: Type, node: yaml.Node) -> Any:
        match type_:
            case Primitive():
                return self._primitive(type_, node)
            case Array():
                items = [self._primitive(type_.element, item) for item in self._items(type_, node)]
                return np.array(items, type_.element.dtype)
            case Sequence():
                return [self.value(type_.element, item) for item in self._items(type_, node)]
            case Dictionary():
                return self._dictionary(type_, node)
        return self._declared(type_, node)

    def _declared(self, type_: type[Any], node: yaml.Node) -> Any:
        if issubclass(type_, StructArray):
            return type_([self.value(type_._element_, item) for item in self._items(type_, node)])
        if issubclass(type_, Enum):
            return self._enum(type_, node)
        return self._struct(type_, node)

    def _items(self, type_: Type, node: yaml.Node) -> list[yaml.Node]:
        if isinstance(node, yaml.SequenceNode):
            items: list[yaml.Node] = node.value
            try:
                if isinstance(type_, Array | Sequence):
                    check_count(type_, len(items))
            except EncodeError as error:
                raise self._problem(node, error.reason, type_) from None
            return items
        raise self._problem(node, f"{_shown(node)} is not a list", type_)

    def _text(self, type_: Type, node: yaml.Node) -> str:
        if isinstance(node, yaml.ScalarNode):
            return str(node.value)
        raise self._problem(node, f"{_shown(node)} is not a single value", type_)

    def _primitive(self, type_: Primitive, node: yaml.Node) -> Any:
        text = self._text(type_, node)
        if type_.is_text:
            if type_.bound and len(text.encode()) > type_.bound:
                raise self._problem(node, f"the text is longer than {type_.bound} bytes", type_)
            return text
        if type_ is BOOL:
            if text.lower() in _BOOLS:
                return _BOOLS[text.lower()]
            raise self._problem(node, f"{_shown(node)} is neither true nor false", type_)
        if type_ in (FLOAT, DOUBLE):
            return self._float(type_, text, node)
        return self._int(type_, text, node)

    def _float(self, type_: Primitive, text: str, node: yaml.Node) -> float:
        try:
            number = float(_INFINITE.get(text.lower(), text))
        except ValueError:
            raise self._problem(node, f"{_shown(node)} is not a number", type_) from None
        if type_ is FLOAT and np.isfinite(number) and abs(number) > _MAX_FLOAT:
            raise self._problem(node, f"{text:.40} does not fit into a float", type_)
        return number

    def _int(self, type_: Primitive, text: str, node: yaml.Node) -> int:
        try:
            number = int(text, 0) if text[:3].lower().lstrip("+-")[:2] in ("0x", "0b", "0o") else (
                int(text)
            )  # fmt: skip
        except ValueError:
            raise self._problem(node, f"{_shown(node)} is not a whole number", type_) from None
        bounds = np.iinfo(type_.dtype)
        if not bounds.min <= number <= bounds.max:
            raise self._problem(
                node, f"{text:.40} is out of range: {bounds.min} to {bounds.max}", type_
            )
        return number

    def _enum(self, type_: type[Enum], node: yaml.Node) -> Enum:
        text = self._text(type_, node)
        members = {name.rstrip("_"): member for name, member in type_.__members__.items()}
        if text in members:
            return members[text]
        numbers = {str(member.value): member for member in type_}
        if text in numbers:
            return numbers[text]
        hint = did_you_mean(text, members) or f"there are {', '.join(members)}"
        raise self._problem(node, f"{type_.__name__} has no value {_shown(node)}; {hint}", type_)

    def _struct(self, type_: type[Struct], node: yaml.Node) -> Struct:
        if not isinstance(node, yaml.MappingNode):
            raise self._problem(node, f"{_shown(node)} is not a mapping", type_)
        fields = {
            name: (attribute, inner)
            for attribute, (name, inner) in zip(type_._names_, type_._fields_, strict=True)
        }
        values: dict[str, Any] = {}
        for key, item in node.value:
            name = key.value if isinstance(key, yaml.ScalarNode) else ""
            if name not in fields:
                hint = did_you_mean(name, fields) or f"it has {', '.join(fields) or 'no fields'}"
                text = f"{type_.__name__} has no field {_shown(key)}; {hint}"
                raise self._problem(key, text, type_)
            attribute, inner = fields[name]
            if attribute in values:
                raise self._problem(key, f"the field `{name}` is given twice", type_)
            values[attribute] = self.value(inner, item)
        return type_(**values)

    def _dictionary(self, type_: Dictionary, node: yaml.Node) -> dict[Any, Any]:
        if isinstance(node, yaml.MappingNode):
            pairs = node.value
        elif isinstance(node, yaml.SequenceNode):
            pairs = [self._pair(type_, item) for item in node.value]
        else:
            raise self._problem(node, f"{_shown(node)} is not a mapping", type_)
        found: dict[Any, Any] = {}
        for key, item in pairs:
            converted = self.value(type_.key, key)
            if converted in found:
                raise self._problem(key, f"the key {_shown(key)} is given twice", type_)
            found[converted] = self.value(type_.value, item)
        return found

    def _pair(self, type_: Dictionary, node: yaml.Node) -> tuple[yaml.Node, yaml.Node]:
        """An entry of a list of `key` and `value`."""
        if isinstance(node, yaml.MappingNode):
            entry = {key.value: item for key, item in node.value if isinstance(key.value, str)}
            if entry.keys() == {"key", "value"}:
                return entry["key"], entry["value"]
        raise self._problem(node, "an entry is {key: …, value: …}", type_)

    def _problem(self, node: yaml.Node, message: str, type_: Type) -> CliError:
        mark = node.start_mark
        return self.problem_at(mark.line, mark.column, message, type_)

    def problem_at(self, line: int, column: int, message: str, type_: Type) -> CliError:
        """An error at a place of the text; both from 0."""
        line = min(line, len(self._lines) - 1)
        where = f"line {line + 1}, column {column + 1}" if line else f"column {column + 1}"
        return CliError(
            EXIT_USAGE,
            f"{self._name}, {where}: {message}\n"
            f"  {self._lines[line]}\n"
            f"  {' ' * column}^\n"
            f"  expected: {type_name(type_)}, such as {example(type_)}",
        )


def _shown(node: yaml.Node) -> str:
    if isinstance(node, yaml.ScalarNode):
        return f"`{node.value:.60}`"
    return "a list" if isinstance(node, yaml.SequenceNode) else "a mapping"

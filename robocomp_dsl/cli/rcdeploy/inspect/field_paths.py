"""Paths to a field of a message, such as `pose.joints[2].angle`.

In: a path and the fields of an operation. Out: the type at the path and a function that selects it,
or a `CliError` that shows the column.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from operator import attrgetter
from typing import Any, NamedTuple

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.type_names import type_name
from robocomp_dsl.client import to_plain
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Fields, Sequence, Type
from robocomp_dsl.runtime.data.struct import Struct

_STEP = re.compile(r"\.?(?P<name>[A-Za-z_][A-Za-z0-9_]*)|\[(?P<index>[^\]]*)\]")
Selector = Callable[[tuple[Any, ...]], Any]
"""From the arguments of an operation to plain data; None if the message has no such element."""


class _Step(NamedTuple):
    text: str
    is_index: bool
    column: int


def select_field(fields: Fields, path: str, argument: str, column: int) -> Selector:
    """A function that selects `path`, which begins at `column` of the word `argument`.

    An empty path selects the message: the only parameter, or a dict of several. Raises `CliError`.
    """
    steps = _parse(path, argument, column)
    position, steps = _parameter(fields, steps, argument)
    if position is None:
        return lambda values: {
            name: to_plain(type_, value)
            for (name, type_), value in zip(fields, values, strict=True)
        }
    type_ = fields[position][1]
    getters: list[Callable[[Any], Any]] = []
    for step in steps:
        getter, type_ = _resolve(type_, step, argument)
        getters.append(getter)

    def select(values: tuple[Any, ...]) -> Any:
        value = values[position]
        try:
            for getter in getters:
                value = getter(value)
        except (IndexError, KeyError):
            return None
        return to_plain(type_, value)

    return select


def _parse(path: str, argument: str, column: int) -> list[_Step]:
    steps, at = [], 0
    while at < len(path):
        match = _STEP.match(path, at)
        if match is None:
            raise _problem("write fields as in pose.joints[2].angle", argument, column + at)
        is_index = match["index"] is not None
        name = match["index"] if is_index else match["name"]
        steps.append(_Step(name, is_index, column + match.start("index" if is_index else "name")))
        at = match.end()
    return steps


def _parameter(fields: Fields, steps: list[_Step], argument: str) -> tuple[int | None, list[_Step]]:
    """Which parameter the path begins in; a single one need not be named."""
    names = [name for name, _ in fields]
    if len(fields) == 1:
        type_ = fields[0][1]
        has_field = bool(steps) and steps[0].text in _field_names(type_)
        is_named = bool(steps) and not steps[0].is_index and steps[0].text == names[0]
        return 0, steps[1:] if is_named and not has_field else steps
    if not steps:
        return None, steps
    if steps[0].is_index or steps[0].text not in names:
        raise _unknown("parameter", steps[0], names, argument)
    return names.index(steps[0].text), steps[1:]


def _field_names(type_: Type) -> list[str]:
    is_struct = isinstance(type_, type) and issubclass(type_, Struct)
    return [name for name, _ in type_._fields_] if is_struct else []  # type: ignore[union-attr]


def _resolve(type_: Type, step: _Step, argument: str) -> tuple[Callable[[Any], Any], Type]:
    if step.is_index:
        return _element(type_, step, argument)
    if isinstance(type_, type) and issubclass(type_, Struct):
        for attribute, (name, inner) in zip(type_._names_, type_._fields_, strict=True):
            if name == step.text:
                return attrgetter(attribute), inner
        raise _unknown("field", step, _field_names(type_), argument)
    hint = "; select an element with [0]" if _element_type(type_) else ""
    raise _problem(f"{type_name(type_)} has no fields{hint}", argument, step.column)


def _element(type_: Type, step: _Step, argument: str) -> tuple[Callable[[Any], Any], Type]:
    if isinstance(type_, Dictionary):
        key = step.text.strip("'\"")
        by_text = lambda value: next(  # noqa: E731 - a getter like the others
            v for k, v in value.items() if str(to_plain(type_.key, k)) == key
        )
        return lambda value: _found(by_text, value), type_.value
    element = _element_type(type_)
    if element is None:
        raise _problem(f"{type_name(type_)} has no elements", argument, step.column)
    try:
        index = int(step.text)
    except ValueError:
        raise _problem("an index is a whole number, as in [0]", argument, step.column) from None
    return lambda value: value[index], element


def _found(search: Callable[[Any], Any], value: Any) -> Any:
    try:
        return search(value)
    except StopIteration:
        raise KeyError from None


def _element_type(type_: Type) -> Type | None:
    if isinstance(type_, Array | Sequence):
        return type_.element
    if isinstance(type_, type) and issubclass(type_, StructArray):
        return type_._element_
    return None


def _unknown(kind: str, step: _Step, names: list[str], argument: str) -> CliError:
    hint = did_you_mean(step.text, names) or f"there are {', '.join(names) or 'none'}"
    return _problem(f"there is no {kind} `{step.text}`; {hint}", argument, step.column)


def _problem(message: str, argument: str, column: int) -> CliError:
    return CliError(
        EXIT_FINDINGS, f"column {column + 1}: {message}\n  {argument}\n  {' ' * column}^"
    )

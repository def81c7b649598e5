"""Functions of `mapping.py` for received messages: their lengths and time stamps.

In: an input of a bridge and the names. Out: `MappingFunction`s.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.places import place
from robocomp_dsl.model.bridge_ports import BridgeInput, LengthCheck
from robocomp_dsl.model.types import Field, Struct, Type
from robocomp_dsl.model.types import Sequence as SequenceType
from robocomp_dsl.model.units import parse_unit
from robocomp_dsl.record import ValueRecord

_NANOSECONDS = 1_000_000_000


CONTEXT = ("at: MessageContext", "user: BridgeWorker")
"""The first parameters of functions that build messages."""


class MappingFunction(ValueRecord):
    """One function; `places` has the place of each assigned field of the message by its path."""

    name: str
    parameters: str
    returns: str
    doc: str
    lines: tuple[str, ...]
    places: tuple[tuple[str, str], ...] = ()


def own_checks(item: BridgeInput) -> tuple[LengthCheck, ...]:
    """The lengths that the bridge declares; a codec checks those of ROS definitions."""
    return tuple(check for check in item.length_checks if not _is_fixed_array(check))


def _is_fixed_array(check: LengthCheck) -> bool:
    type_ = check.path[-1].type if check.path else None
    return isinstance(type_, SequenceType) and type_.is_anonymous


def input_locals(
    inputs: Iterable[BridgeInput], names: BridgeNames
) -> tuple[dict[tuple[str, str], str], list[str]]:
    """The local names of the parameters of inputs, and the lines that unpack several of them."""
    found: dict[tuple[str, str], str] = {}
    lines = []
    for item in inputs:
        variable = names.variables[item.name]
        parameters = item.parameters
        if len(parameters) == 1:
            found[item.name, parameters[0].name] = variable
            continue
        parts = [f"{variable}_{parameter.name}" for parameter in parameters]
        found |= {(item.name, p.name): part for p, part in zip(parameters, parts, strict=True)}
        lines.append(f"{', '.join(parts)} = {variable}")
    return found, lines


def annotation_of(item: BridgeInput, names: BridgeNames) -> str:
    """The annotation of the value of an input."""
    kinds = [names.annotation(parameter.type) for parameter in item.parameters]
    return kinds[0] if len(kinds) == 1 else f"tuple[{', '.join(kinds) or '()'}]"


def check_function(item: BridgeInput, names: BridgeNames) -> MappingFunction:
    """Checks the lengths that the type of an input declares."""
    first = "message" if len(item.parameters) == 1 else "message[0]"
    lines = []
    for check in own_checks(item):
        path = _path(first, item.parameters[0].type, check.path, names)
        lines.append(f"values.with_length({path}, {check.length}, {check.length})")
    return MappingFunction(
        f"check_{item.name}",
        f"message: {annotation_of(item, names)}",
        "None",
        f"Check the lengths of a message of the input `{item.name}` ({place(item.port.span)}).",
        tuple(lines),
    )


def stamp_function(item: BridgeInput, names: BridgeNames) -> MappingFunction:
    """Reads the time stamp of a message of an input."""
    first, path, type_ = "message", item.stamp_path, item.parameters[0].type
    if len(item.parameters) > 1:
        index = next(i for i, p in enumerate(item.parameters) if p.name == path[0].name)
        first, type_ = f"message[{index}]", item.parameters[index].type
        path = path[1:]
    text = _path(first, type_, path, names)
    last = item.stamp_path[-1]
    if isinstance(last.type, Struct):
        second, part = (names.field(last.type, f) for f in last.type.fields[:2])
        result = f"{text}.{second} * {_NANOSECONDS:_} + {text}.{part}"
    else:
        factor = float(parse_unit(last.unit or "s").factor) * _NANOSECONDS
        result = f"values.nanoseconds_of({text}, {factor:_.0f})"
    return MappingFunction(
        f"stamp_{item.name}",
        f"message: {annotation_of(item, names)}",
        "int",
        f"The time stamp of a message of the input `{item.name}` [ns] ({place(item.port.span)}).",
        (f"return {result}",),
    )


def _path(start: str, type_: Type, path: Sequence[Field], names: BridgeNames) -> str:
    text = start
    for field in path:
        text += f".{names.field(type_, field)}"
        type_ = field.type
    return text

"""The lines that build one argument of an operation: a value, then assignments to its fields."""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.bridge.bridge_names import BridgeNames, element_dtype
from robocomp_dsl.generate.bridge.expressions import ExpressionPrinter
from robocomp_dsl.generate.bridge.places import place
from robocomp_dsl.generate.literals import quoted
from robocomp_dsl.generate.python.python_types import record_element
from robocomp_dsl.model.bridge_values import BuiltValue, ConstantValue, Expression, StructOf
from robocomp_dsl.model.types import (
    BOOL,
    DOUBLE,
    FLOAT,
    STRING,
    Field,
    Primitive,
    Type,
)
from robocomp_dsl.model.types import Sequence as SequenceType

Path = Sequence[Field | int]


class BuiltLines:
    """Collects the lines and places of the arguments of one operation.

    `single`: paths of fields omit the name of the only parameter. `prefix` precedes all paths.
    """

    def __init__(
        self, printer: ExpressionPrinter, names: BridgeNames, *, single: bool, prefix: str = ""
    ) -> None:
        self.printer = printer
        self.names = names
        self.single = single
        self.prefix = prefix
        self.lines: list[str] = []
        self.places: list[tuple[str, str]] = []

    def locate(self, path: str, expression: Expression) -> None:
        """Note which field is computed next, for messages about errors; a constant never fails."""
        if not isinstance(expression, ConstantValue):
            self.lines.append(f"at.field = {quoted(path)}")
        self.places.append((path, place(expression.span)))


def value_lines(value: BuiltValue, variable: str, built: BuiltLines) -> str:
    """Add the lines for one argument; returns the variable that has it."""
    root = built.prefix + ("" if built.single else value.param.name)
    if value.value is not None:
        built.locate(root, value.value)
        text = built.printer.statement(value.value)
        is_shared = bool(value.assignments) and not isinstance(value.value, StructOf)
        built.lines.append(f"{variable} = {f'copy({text})' if is_shared else text}")
        copied: set[str] = {variable} if is_shared else set()
    else:
        built.lines.append(f"{variable} = {default_text(value.param.type, built.names)}")
        is_shared, copied = False, set()
    for assignment in value.assignments:
        if is_shared:
            _copy_parts(variable, value.param.type, assignment.path, copied, built)
        target = _target(variable, value.param.type, assignment.path, built.names)[-1]
        shown = _shown(assignment.path)
        built.locate(
            f"{root}.{shown}" if root and not root.endswith(".") else root + shown, assignment.value
        )
        built.lines.append(f"{target} = {built.printer.statement(assignment.value)}")
    return variable


def _copy_parts(
    variable: str, type_: Type, path: Path, copied: set[str], built: BuiltLines
) -> None:
    """Copy the structs and lists on the way to a field: others may use the received message."""
    for part in _target(variable, type_, path, built.names)[:-1]:
        if part not in copied:
            copied.add(part)
            built.lines.append(f"{part} = copy({part})")


def _target(variable: str, type_: Type, path: Path, names: BridgeNames) -> list[str]:
    """The expressions of all parts of a path; the last one is the field."""
    parts, text = [], variable
    for part in path:
        if isinstance(part, int):
            text = f"{text}[{part}]"
            type_ = type_.element if isinstance(type_, SequenceType) else type_
        else:
            text, type_ = f"{text}.{names.field(type_, part)}", part.type
        parts.append(text)
    return parts


def _shown(path: Path) -> str:
    """`points[0].x`, with the names of the description."""
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part.name}"
    return text.removeprefix(".")


def default_text(type_: Type, names: BridgeNames) -> str:
    """The default of a type as Python."""
    if isinstance(type_, Primitive):
        if type_ in (FLOAT, DOUBLE):
            return "0.0"
        zeros: dict[Primitive, str] = {BOOL: "False", STRING: '""'}
        return '""' if type_.is_text else zeros.get(type_, "0")
    if isinstance(type_, SequenceType):
        dtype = element_dtype(type_)
        if dtype:
            return f"np.zeros({type_.size}, {dtype})"
        is_array = record_element(type_) is not None and not type_.is_anonymous
        return f"{names.type_name(type_)}()" if is_array else "[]"
    return f"{names.type_name(type_)}()"

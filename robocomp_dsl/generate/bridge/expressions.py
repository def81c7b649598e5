"""Typed expressions of a bridge as Python.

In: an expression of the model, in which every conversion is a node. Out: source text. Numbers are
ints and floats, sequences of numbers numpy arrays, instants ints in ns. `values` is the module
`robocomp_dsl.runtime.bridge.values`, `at` a `MessageContext`, `user` the worker.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.generate.bridge.bridge_names import (
    BridgeNames,
    element_dtype,
    primitive_dtype,
    struct_of,
)
from robocomp_dsl.generate.literals import python_value, quoted
from robocomp_dsl.model import bridge_values as bv
from robocomp_dsl.model.bridge_actions import Compared
from robocomp_dsl.model.bridge_ports import ItemsType, TimeType
from robocomp_dsl.model.types import DOUBLE, FLOAT, NUMBERS, Enum, Primitive, Sequence, Struct

_TIME_FIELDS = 2
_SECOND = "1_000_000_000"


class ExpressionPrinter:
    """Prints expressions; `locals` are names of what is not a variable of the whole bridge.

    The keys are `(name of the call or input or "", name of the parameter)`.
    """

    def __init__(self, names: BridgeNames, local_names: dict[tuple[str, str], str]) -> None:
        self._names = names
        self._locals = local_names

    def text(self, node: bv.Expression) -> str:
        """The expression as Python; an operand of any operator."""
        return _PRINTERS[type(node)](self, node)

    def statement(self, node: bv.Expression) -> str:
        """The expression as Python where no operator is beside it."""
        return without_brackets(self.text(node))

    def _input(self, node: bv.InputValue) -> str:
        return self._locals[node.input.name, node.param.name]

    def _hub(self, node: bv.HubValue) -> str:
        return self._names.variables[node.hub.name]

    def _request(self, node: bv.RequestValue) -> str:
        return self._locals["", node.param.name]

    def _reply(self, node: bv.ReplyValue) -> str:
        return self._locals[node.call.name, node.param.name]

    def _field(self, node: bv.FieldOf) -> str:
        return f"{self.text(node.value)}.{self._names.field(node.value.type, node.field)}"

    def _item(self, node: bv.ItemAt) -> str:
        item = f"values.element({self.text(node.value)}, {node.index})"
        holder = node.value.type.number if isinstance(node.value.type, ItemsType) else None
        is_rounded = holder in (FLOAT, DOUBLE) and node.type not in (FLOAT, DOUBLE)
        return f"int({item})" if is_rounded else item

    def _selected(self, node: bv.Selected) -> str:
        indices = ", ".join(map(str, node.indices))
        comma = "," * (len(node.indices) == 1)
        return f"values.elements({self.text(node.value)}, ({indices}{comma}))"

    def _sliced(self, node: bv.Sliced) -> str:
        if node.stop is None:
            return f"{self.text(node.value)}[{node.start}:]"
        return f"values.part_of({self.text(node.value)}, {node.start}, {node.stop})"

    def _length_checked(self, node: bv.LengthChecked) -> str:
        return f"values.with_length({self.text(node.value)}, {node.minimum}, {node.maximum})"

    def _negated(self, node: bv.Negated) -> str:
        return f"(-{self.text(node.value)})"

    def _value_function(self, node: bv.NumberOf | bv.TextOf) -> str:
        name = "text"
        if isinstance(node, bv.NumberOf):
            name = "numbers" if node.is_list else "number"
        return f"values.{name}({self.statement(node.value)})"

    def _length(self, node: bv.LengthOf) -> str:
        return f"len({self.text(node.value)})"

    def _stamp(self, node: bv.StampOf) -> str:
        return f"at.stamp_ns({quoted(node.input.name)})"

    def _time_in(self, node: bv.TimeIn) -> str:
        text = self.text(node.value)
        if node.type in (FLOAT, DOUBLE):
            return f"({text} / {_grouped(node.nanoseconds)})"
        return text if node.nanoseconds == 1 else f"({text} // {_grouped(node.nanoseconds)})"

    def _constant(self, node: bv.ConstantValue) -> str:
        if isinstance(node.type, Enum):
            return self._names.enumerator(node.type, str(node.value))
        value = float(node.value) if node.type in (FLOAT, DOUBLE) else node.value
        return python_value(value)

    def _list(self, node: bv.ListExpression) -> str:
        dtype = _dtype(node)
        parts = [self.statement(item) for item in node.items]
        nested = any(item.is_list for item in node.items) and not _is_list_of_lists(node)
        if dtype:
            if nested:
                return f"values.joined({', '.join((dtype, *parts))})"
            return f"np.array([{', '.join(parts)}], {dtype})"
        return f"values.listed({', '.join(parts)})" if nested else f"[{', '.join(parts)}]"

    def _struct(self, node: bv.StructOf) -> str:
        fields = [
            f"{self._names.field(node.type, field)}={self.statement(item)}"
            for field, item in zip(struct_of(node.type).fields, node.items, strict=True)
        ]
        return f"{self._names.type_name(struct_of(node.type))}({', '.join(fields)})"

    def _called(self, node: bv.Called) -> str:
        arguments = ", ".join(map(self.statement, node.arguments))
        call = f"user.{self._names.variables[node.function.name]}({arguments})"
        dtype = element_dtype(node.type)
        return f"np.asarray({call}, {dtype})" if dtype else call

    def _arithmetic(self, node: bv.Arithmetic) -> str:
        left, right = self.text(node.left), self.text(node.right)
        is_unknown = node.left.length is None or node.right.length is None
        if node.left.is_list and node.right.is_list and is_unknown:
            return f"values.item_by_item({quoted(node.operator)}, {left}, {right})"
        text = f"({left} {node.operator} {right})"
        if isinstance(node.left.type, TimeType) and not isinstance(node.type, TimeType):
            return f"({text} / 1_000_000_000)"
        return text

    def _compared(self, node: Compared) -> str:
        left, right = node.left, node.right
        if isinstance(right, bv.ConstantValue) and isinstance(right.value, bool):
            is_same = right.value == (node.operator == "==")
            return self.text(left) if is_same else f"(not {self.text(left)})"
        return f"({self.text(left)} {node.operator} {self.text(right)})"

    def _converted(self, node: bv.Converted) -> str:
        text = self.text(node.value)
        if node.factor != 1:
            text = f"{text} * {python_value(float(node.factor))}"
        if node.offset:
            sign = "-" if node.offset < 0 else "+"
            text = f"{text} {sign} {python_value(abs(float(node.offset)))}"
        return f"({text})"

    def _cast(self, node: bv.Cast) -> str:
        text, source, target = self.text(node.value), node.value.type, node.type
        if isinstance(target, Struct):
            is_time = isinstance(source, TimeType)
            instant = text if is_time else f"values.nanoseconds_of({text}, {_SECOND})"
            return self._time(instant, target)
        if isinstance(target, Primitive) and isinstance(source, Primitive):
            return _number(text, source, target, is_counter=isinstance(node.value, bv.Counter))
        if isinstance(target, (Sequence, ItemsType)):
            return self._sequence(node, text)
        return text

    def _time(self, text: str, target: Struct) -> str:
        second, part = (self._names.field(target, field) for field in target.fields[:_TIME_FIELDS])
        name = self._names.type_name(target)
        return f"values.ros_time({name}, {text}, {quoted(second)}, {quoted(part)})"

    def _sequence(self, node: bv.Cast, text: str) -> str:
        dtype, own = _dtype(node), _dtype(node.value)
        if not dtype:
            return text if isinstance(node.value, bv.ListExpression) else f"values.listed({text})"
        if dtype == own:
            return text
        if dtype in ("np.float64", "np.float32", "np.bool_"):
            return f"np.asarray({text}, {dtype})"
        return f"values.integers({text}, {dtype})"


def _dtype(node: bv.Expression) -> str:
    """The numpy type of the items of a list; "" if they are no numbers."""
    if isinstance(node.type, ItemsType):
        number = node.type.number
        return primitive_dtype(number) if number else ""
    return element_dtype(node.type)


def _is_list_of_lists(node: bv.ListExpression) -> bool:
    """Whether the items themselves are sequences: of a sequence of sequences."""
    return isinstance(node.type, Sequence) and isinstance(node.type.element, Sequence)


def _number(text: str, source: Primitive, target: Primitive, *, is_counter: bool) -> str:
    """A number as another type; widening needs no code."""
    if target in (FLOAT, DOUBLE):
        return text if source in (FLOAT, DOUBLE) else f"float({text})"
    if target not in NUMBERS:
        return text
    low, high = limits(target)
    if is_counter:
        return f"values.wrapped({text}, {_grouped(low)}, {_grouped(high)})"
    if source in NUMBERS and source not in (FLOAT, DOUBLE):
        own_low, own_high = limits(source)
        if low <= own_low and own_high <= high:
            return text
    return f"values.integer({text}, {_grouped(low)}, {_grouped(high)})"


def limits(type_: Primitive) -> tuple[int, int]:
    """The least and the greatest value of an integer type."""
    if type_.is_unsigned:
        return 0, 2**type_.bits - 1
    return -(2 ** (type_.bits - 1)), 2 ** (type_.bits - 1) - 1


def without_brackets(text: str) -> str:
    """`text` without a pair of parentheses around all of it."""
    if not (text.startswith("(") and text.endswith(")")):
        return text
    depth = 0
    for index, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if not depth and index < len(text) - 1:
            return text
    return text[1:-1]


def _grouped(number: int) -> str:
    """`1_000_000`."""
    return f"{number:_}"


_PRINTERS: dict[type[bv.Expression], Callable[[ExpressionPrinter, Any], str]] = {
    bv.ConstantValue: ExpressionPrinter._constant,
    bv.ListExpression: ExpressionPrinter._list,
    bv.InputValue: ExpressionPrinter._input,
    bv.HubValue: ExpressionPrinter._hub,
    bv.RequestValue: ExpressionPrinter._request,
    bv.ReplyValue: ExpressionPrinter._reply,
    bv.FieldOf: ExpressionPrinter._field,
    bv.ItemAt: ExpressionPrinter._item,
    bv.Selected: ExpressionPrinter._selected,
    bv.Sliced: ExpressionPrinter._sliced,
    bv.LengthChecked: ExpressionPrinter._length_checked,
    bv.Called: ExpressionPrinter._called,
    bv.Arithmetic: ExpressionPrinter._arithmetic,
    bv.Negated: ExpressionPrinter._negated,
    bv.Converted: ExpressionPrinter._converted,
    bv.NumberOf: ExpressionPrinter._value_function,
    bv.TextOf: ExpressionPrinter._value_function,
    bv.LengthOf: ExpressionPrinter._length,
    bv.StampOf: ExpressionPrinter._stamp,
    bv.Now: lambda _printer, _node: "at.now_ns",
    bv.Counter: lambda _printer, _node: "at.counter",
    bv.Cast: ExpressionPrinter._cast,
    bv.TimeIn: ExpressionPrinter._time_in,
    Compared: ExpressionPrinter._compared,
    bv.StructOf: ExpressionPrinter._struct,
}

"""Typed expressions of a bridge, and the hubs and calls that they refer to.

Each implicit conversion of the language is an explicit node, so a generator only prints. At run
time a number is an int or float, a sequence of numbers a numpy array, another sequence a list, a
struct an object of its generated class, an instant an int [ns].
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum

from robocomp_dsl.model.bridge_ports import (
    BridgeFunction,
    BridgeInput,
    BridgePort,
    ItemsType,
    ValueType,
)
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import Field, Literal, Sequence
from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span


class Expression(Record):
    """A typed expression; `span` is its text in the BDSL file.

    `unit` is as written, without brackets, "" for none. `length` is the number of items of a list
    or sequence, None if it is no list or the number is known at run time only.
    """

    span: Span
    type: ValueType
    unit: str
    length: int | None

    @property
    def is_list(self) -> bool:
        """Whether it has items: a sequence, a hub, or `{ a, b }`."""
        return isinstance(self.type, (ItemsType, Sequence))

    def children(self) -> tuple[Expression, ...]:
        """The expressions that it consists of, in order."""
        children: list[Expression] = []
        for name in type(self).__match_args__[_SHARED_FIELDS:]:
            value = getattr(self, name)
            parts = value if isinstance(value, tuple) else (value,)
            children += [part for part in parts if isinstance(part, Expression)]
        return tuple(children)

    def walk(self) -> Iterator[Expression]:
        """The expression and all expressions in it; those of a hub are not in it."""
        yield self
        for child in self.children():
            yield from child.walk()


_SHARED_FIELDS = len(Expression.__match_args__)
"""The first fields of all expressions are no expressions."""


class ConstantValue(Expression):
    """A literal. An enumerator is its name, with an enum as type."""

    value: Literal


class ListExpression(Expression):
    """`{ a, b }`; with the type of a sequence if it was converted to one."""

    items: tuple[Expression, ...]


class InputValue(Expression):
    """The parameter `param` of the newest message of an input (of the hub's message in a hub)."""

    input: BridgeInput
    param: Param


class HubValue(Expression):
    """The items of a hub."""

    hub: BridgeHub


class RequestValue(Expression):
    """The parameter `param` of the request of a service."""

    param: Param


class ReplyValue(Expression):
    """What a call of a service returned: its out parameter `param`; `result` is its result."""

    call: BridgeCall
    param: Param


class FieldOf(Expression):
    """A field of a struct."""

    value: Expression
    field: Field


class ItemAt(Expression):
    """`wheels[0]`: one item; a missing item is an error of the message at run time."""

    value: Expression
    index: int


class Selected(Expression):
    """`wheels[2,0,1]`: several items in this order."""

    value: Expression
    indices: tuple[int, ...]


class Sliced(Expression):
    """`wheels[0:3]`: the items from `start` up to `stop`, which is excluded; None: the end."""

    value: Expression
    start: int
    stop: int | None


class LengthChecked(Expression):
    """`value`, whose length is checked at run time: `minimum` … `maximum` items."""

    value: Expression
    minimum: int
    maximum: int


class Called(Expression):
    """The call of a user function; the arguments have the types and units of its parameters."""

    function: BridgeFunction
    arguments: tuple[Expression, ...]


class Arithmetic(Expression):
    """`left operator right` with `+`, `-`, `*` or `/`; item by item if one is a list.

    Two instants may be subtracted, which gives a `double [s]`. Two lists must have the same length.
    """

    operator: str
    left: Expression
    right: Expression


class Negated(Expression):
    """`-value`, item by item for a list."""

    value: Expression


class Converted(Expression):
    """`value * factor + offset`: another unit; item by item for a list. The type is double."""

    value: Expression
    factor: float
    offset: float


class NumberOf(Expression):
    """`number(x)`: a double from a string, bool or number.

    A string that is no number is an error of the message at run time.
    """

    value: Expression


class TextOf(Expression):
    """`text(x)`: a string from a string, bool or number."""

    value: Expression


class LengthOf(Expression):
    """`length(x)`: the number of items, or of characters of a string; an int."""

    value: Expression


class StampOf(Expression):
    """`stamp(input)`: the time stamp of the newest message of an input; an instant."""

    input: BridgeInput


class Now(Expression):
    """The instant at which the message is built, the same for all its fields."""


class Counter(Expression):
    """The number of messages that this output has sent, from 0; a long."""


class Cast(Expression):
    """`value` as another type.

    number → number: widening, or exact by a check of the range at run time; a double is rounded to
    an integer; a `Counter` wraps around. Items → sequence, each with its type. A list of numbers
    may be cast as a whole. Instant, or `double [s]` → the ROS struct `Time` or `Duration` (`sec`,
    `nanosec`).
    """

    value: Expression


class TimeIn(Expression):
    """An instant as a number of units since 1970; `nanoseconds` is the length of one unit."""

    value: Expression
    nanoseconds: int


class StructOf(Expression):
    """A new struct with all its fields in order; `items` have the types of the fields."""

    items: tuple[Expression, ...]


class FieldAssignment(Record):
    """`header.frame_id = value`; a part of the path is a field, or the index of an element."""

    path: tuple[Field | int, ...]
    value: Expression


class BuiltValue(Record):
    """One argument of an operation: `value`, or the default of its type, then the assignments.

    `value` None: the default of the type, which `assignments` change. If `value` comes from a
    received message, the assignments change a copy of it.
    """

    param: Param
    value: Expression | None
    assignments: tuple[FieldAssignment, ...] = ()


class HubPolicy(StrEnum):
    """When a hub is ready: see "Semantics" in the documentation of BDSL."""

    LATEST = "latest"
    ALL = "all"
    SYNCHRONISED = "synchronised"


class BridgeHub(Record):
    """Concatenates its values. `inputs` are those it receives from, in order of first use.

    A scalar is appended, a sequence or list is joined item by item (the items of a `ListExpression`
    are not joined: a struct is a list of its fields). `tolerance_s` is set for `synchronised` only.
    `max_age_s` 0: any age. `length`: the declared number of items, which is checked at run time;
    None: not declared, or already known.
    """

    name: str
    values: tuple[Expression, ...]
    inputs: tuple[BridgeInput, ...]
    type: ItemsType
    policy: HubPolicy
    span: Span
    tolerance_s: float = 0.0
    max_age_s: float = 0.0
    length: int | None = None
    doc: str = ""


class BridgeCall(Record):
    """A call that a service makes when it is called itself, in the order of writing."""

    name: str
    port: BridgePort
    arguments: tuple[BuiltValue, ...]


class ExpressionUse(ValueRecord):
    """What the expressions of an output read.

    A new message of `inputs` or a new set of `hubs` makes the output ready again; of the inputs in
    `stamps` only the time stamp is read, so they only have to have arrived once.
    """

    inputs: tuple[BridgeInput, ...] = ()
    hubs: tuple[BridgeHub, ...] = ()
    stamps: tuple[BridgeInput, ...] = ()

"""Ports, inputs and functions of a bridge, and the types that only its expressions have."""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.model.component import Role
from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.model.interface import Interface, Operation, Param
from robocomp_dsl.model.types import DOUBLE, FLOAT, NUMBERS, Field, Primitive, Type
from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span


class TimeType(ValueRecord):
    """An instant: `now` and `stamp(input)`; nanoseconds since 1970 when the bridge runs."""

    name: str = "time"


TIME = TimeType()


class ItemGroup(ValueRecord):
    """Consecutive items of one type and unit; `count` None: known at run time only."""

    type: ValueType
    unit: str = ""
    count: int | None = 1


class ItemsType(ValueRecord):
    """The type of a hub, of `{ a, b }`, and of a selection of several items.

    At run time it is a one-dimensional numpy array if `number` is not None, otherwise a list.
    """

    groups: tuple[ItemGroup, ...]
    name: str = "list"

    @property
    def count(self) -> int | None:
        """The number of items; None if it is known at run time only."""
        counts = [group.count for group in self.groups]
        return None if None in counts else sum(count for count in counts if count is not None)

    @property
    def number(self) -> Primitive | None:
        """The type that holds every item, if all are numbers: of integers the widest."""
        types = [group.type for group in self.groups]
        numbers = [t for t in types if isinstance(t, Primitive) and t in NUMBERS]
        return common_number(numbers) if numbers and len(numbers) == len(types) else None

    @property
    def unit(self) -> str:
        """The unit of all items; empty if they have several or none."""
        units = {group.unit for group in self.groups}
        return units.pop() if len(units) == 1 else ""


ValueType: TypeAlias = Type | TimeType | ItemsType


def common_number(types: list[Primitive]) -> Primitive:
    """The number type that holds the values of all `types`; double if one has a fraction."""
    if len(set(types)) == 1:
        return types[0]
    if any(t in (FLOAT, DOUBLE) for t in types):
        return DOUBLE
    signed = [t for t in types if not t.is_unsigned]
    widest = max(types, key=lambda t: t.bits)
    return max(signed, key=lambda t: t.bits) if signed and widest.is_unsigned else widest


class BridgePort(Record):
    """The port of the component that an input, output, service or call becomes.

    `name` is that of the port in CDSL. `interface` is imported, or declared by the types module of
    the bridge (`is_own`). `address` is that of the peer, or for a served port its own; "": any.
    """

    name: str
    role: Role
    interface: Interface
    operation: Operation
    middleware: str
    address: str
    qos: Qos
    span: Span
    is_own: bool = False


class LengthCheck(ValueRecord):
    """The number of elements that the sequence at `path` of a received value must have."""

    path: tuple[Field, ...]
    length: int


class BridgeInput(Record):
    """A topic or one-way operation that the bridge receives. `parameters`: of the operation.

    `type` and `unit` are those of the only parameter; with several parameters `type` is the items
    of all. `stamp_path`: the field with the time stamp; empty: that of the middleware, else of the
    header, else the arrival. `length_checks` hold for the first parameter.
    """

    name: str
    port: BridgePort
    type: ValueType
    unit: str
    stamp_path: tuple[Field, ...] = ()
    length_checks: tuple[LengthCheck, ...] = ()
    doc: str = ""

    @property
    def parameters(self) -> tuple[Param, ...]:
        """The parameters of its operation."""
        return self.port.operation.inputs


class BridgeFunction(Record):
    """A method that the user writes. A sequence of numbers is a numpy array."""

    name: str
    parameters: tuple[Param, ...]
    result: Type
    unit: str
    span: Span
    doc: str = ""

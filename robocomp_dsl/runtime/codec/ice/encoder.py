"""Generates encoders of Ice's wire format. In: a schema. Out: a Python function to bytes.

Adjacent numbers become one call of a `struct.Struct`; there is no padding. For a laser scan with a
name the body is, apart from names:

    s1 = a1.name.encode()
    l1 = len(s1)
    l2 = len(a2)
    parts = (SMALL[l1] if l1 < 255 else large(l1), s1, K1(a1.x, a1.y), …, a2)
    return join((head(sum(map(len, parts)) + 6, 257), *parts))
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.explain import explain
from robocomp_dsl.runtime.codec.ice import rows, wire
from robocomp_dsl.runtime.codec.source_writer import SourceWriter
from robocomp_dsl.runtime.codec.struct_arrays import checker
from robocomp_dsl.runtime.data.convert import FLAGS, as_array, as_list
from robocomp_dsl.runtime.data.declared_error import DeclaredError
from robocomp_dsl.runtime.data.layout import row_layout
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct


def encoder_function(fields: Fields, form: str, order: tuple[int, ...]) -> Callable[[Any], bytes]:
    """The encoder; `form` is the form of the values: `none`, `one` or `tuple`.

    `order` are the indices of the fields in their order on the wire.
    """
    writer = _Encoder()
    writer.message(fields, form, order)

    def failed(values: Any, failure: Exception) -> Exception:
        return explain(fields, form, values, failure)

    writer.names["failed"] = failed
    tail = "    except Exception as e:\n        failure = e\n    raise failed(value, failure)"
    return writer.compiled("def encode(value):", tail, "encode")


class _EnumSizes(dict[int, Any]):
    """What an enumerator is on the wire."""

    def __missing__(self, value: int) -> Any:
        raise ValueError(f"Ice has no negative enumerators, such as {value}")


class _Encoder(SourceWriter):
    """`run` are the adjacent numbers, `parts` the expressions of the pieces not yet joined."""

    def __init__(self) -> None:
        names = {"join": b"".join, "ndarray": np.ndarray, "as_array": as_array}
        names |= {"SMALL": wire.SMALL, "large": wire.large, "head": wire.HEADER.pack}
        super().__init__(names | {"u1": np.uint8})
        self.run: list[tuple[str, str]] = []
        self.parts: list[str] = []
        self.spilled = False
        self.is_fixed = True

    def message(self, fields: Fields, form: str, order: tuple[int, ...]) -> None:
        """The complete body."""
        names = ["value"]
        if form == "tuple":
            names = [self.name("a") for _ in fields]
            self.line(f"[{', '.join(names)}] = value")
        for index in order:
            self.value(fields[index][1], names[index])
        if form == "none":
            self.line("if value is not None: raise TypeError")
        if self.is_fixed:
            size = struct.calcsize("<iH" + "".join(code for code, _ in self.run))
            self.run[:0] = [("i", str(size)), ("H", str(wire.VERSION))]
            self.flush()
            self.line(f"return {self.parts[0]}")
            return
        self.flush()
        if self.spilled:
            self.spill()
        else:
            self.line(f"parts = ({', '.join(self.parts)},)")
        self.line(f"size = sum(map(len, parts)) + {wire.HEADER.size}")
        self.line(f"return join((head(size, {wire.VERSION}), *parts))")

    def flush(self) -> None:
        """Emit one `pack` for the pending numbers."""
        if not self.run:
            return
        layout = struct.Struct("<" + "".join(code for code, _ in self.run))
        values = ", ".join(value for _, value in self.run if value)
        self.run = []
        self.parts.append(f"{self.constant(layout.pack)}({values})")

    def part(self, expression: str) -> None:
        """A piece of the message whose length varies."""
        self.flush()
        self.is_fixed = False
        self.parts.append(expression)

    def spill(self) -> None:
        """Move the previous pieces into a list, which loops extend."""
        parts, self.parts = ", ".join(self.parts), []
        if not self.spilled:
            self.line(f"parts = [{parts}]")
        elif parts:
            self.line(f"parts += ({parts},)")
        self.spilled = True

    def value(self, type_: Type, expression: str) -> None:
        """One value of any type."""
        match type_:
            case Primitive():
                self.primitive(type_, expression)
            case Array():
                self.array(type_, expression)
            case Sequence():
                name = self.items(expression)
                self.limit(type_, f"len({name})")
                self.sequence(type_.element, name)
            case Dictionary():
                self.dictionary(type_, expression)
            case _ if issubclass(type_, Struct):
                self.record(type_, expression)
            case _ if issubclass(type_, Enum):
                self.enum(type_, expression)
            case _:
                self.struct_array(type_, expression)

    def primitive(self, type_: Primitive, expression: str) -> None:
        """A number, a bool or a string."""
        if type_.is_text:
            text = self.name("s")
            self.line(f"{text} = {expression}.encode()")
            if type_.bound:
                self.line(f"if len({text}) > {type_.bound}: raise ValueError")
            self.size(text)
            self.part(text)
        elif type_ is BOOL:
            self.run.append(("?", f"{self.constant(FLAGS)}[{expression}]"))
        else:
            self.run.append((type_.code, expression))

    def enum(self, type_: type[Enum], expression: str) -> None:
        """The size of its value."""
        values = [int(member) for member in type_]
        if rows.is_one_byte(type_):
            sizes = self.constant(_EnumSizes((value, value) for value in values))
            self.run.append(("B", f"{sizes}[{expression}]"))
            return
        pieces = _EnumSizes((value, wire.size_bytes(value)) for value in values if value >= 0)
        self.part(f"{self.constant(pieces)}[{expression}]")

    def size(self, name: str) -> None:
        """The number of elements of `name`, which has a length."""
        count = self.name("n")
        self.line(f"{count} = len({name})")
        self.part(f"SMALL[{count}] if {count} < 255 else large({count})")

    def record(self, type_: type[Struct], expression: str) -> None:
        """The fields in order. A struct without fields is one byte, as `rcgen` exports it."""
        if not type_._fields_ and not issubclass(type_, DeclaredError):
            self.run.append(("x", ""))
        name = self.assigned("v", expression)
        for attribute, (_, inner) in zip(type_._names_, type_._fields_, strict=True):
            self.value(inner, f"{name}.{attribute}")

    def array(self, type_: Array, expression: str) -> None:
        """A numpy array; its memory is a piece of the message. Ice has no arrays of fixed size."""
        dtype = type_.element.dtype
        name = self.assigned("a", expression)
        kind, strides = self.constant(dtype), f"({dtype.itemsize},)"
        self.line(
            f"if {name}.__class__ is not ndarray or {name}.dtype is not {kind}"
            f" or {name}.strides != {strides}: {name} = as_array({name}, {kind})"
        )
        self.limit(type_, f"len({name})")
        self.size(name)
        self.part(f"{name}.view(u1)")

    def struct_array(self, type_: Any, expression: str) -> None:
        """A structured array, copied from memory if wire and memory layout are the same."""
        packed = rows.packed_rows(type_._element_)
        source, cls = self.assigned("a", expression), self.constant(type_)
        if packed is None:
            self.line(f"if {source}.__class__ is not {cls}: {source} = {cls}({source})")
            self.sequence(type_._element_, source)
            return
        name = self.name("a")
        self.line(
            f"{name} = {source}._array if {source}.__class__ is {cls} else {cls}._rows({source})"
        )
        if check := checker(row_layout(type_._element_)):
            self.line(f"{self.constant(check)}({name})")
        self.size(name)
        if packed.direct:
            stride = packed.dtype.itemsize
            self.line(f"if {name}.strides != ({stride},): {name} = {name}.copy()")
            self.part(f"{name}.view(u1)")
        else:
            self.part(f"{self.constant(rows.pack)}({self.constant(packed)}, {name})")

    def items(self, expression: str) -> str:
        """A variable with a list."""
        name = self.assigned("q", expression)
        as_items = self.constant(as_list)
        self.line(f"if {name}.__class__ is not list: {name} = {as_items}({name})")
        return name

    def sequence(self, element: Type, name: str) -> None:
        """The elements of `name`, one by one."""
        item = self.name("e")
        self.size(name)
        self.spill()
        self.nested(f"for {item} in {name}:", lambda: self.element(element, item))

    def dictionary(self, type_: Dictionary, expression: str) -> None:
        """A dict, pair by pair."""
        name, key, item = self.assigned("q", expression), self.name("e"), self.name("e")
        self.size(name)
        self.spill()

        def pair() -> None:
            self.value(type_.key, key)
            self.element(type_.value, item)

        self.nested(f"for {key}, {item} in {name}.items():", pair)

    def element(self, type_: Type, name: str) -> None:
        """The last value of a loop's body."""
        self.value(type_, name)
        self.flush()
        self.spill()

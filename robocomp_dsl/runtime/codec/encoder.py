"""Generates encoders. In: a schema. Out: a Python function from values to bytes.

For a pose with a string in its header the body is, apart from names:

    v1 = value.header
    s1 = v1.frame_id.encode()
    l1 = len(s1)
    t1 = K1(256, v1.sec, v1.nanosec, l1 + 1)       # struct.Struct.pack, with the message's header
    p = 12 + l1
    t2 = K2[p & 7](value.x, value.y, …)            # NUL of the string, padding, 7 doubles
    return join((t1, s1, t2))
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.emitter import Emitter
from robocomp_dsl.runtime.codec.explain import explain
from robocomp_dsl.runtime.codec.struct_arrays import checker, pack
from robocomp_dsl.runtime.codec.wire_profile import CDR, WireProfile
from robocomp_dsl.runtime.data.convert import FLAGS, as_array, as_list
from robocomp_dsl.runtime.data.layout import packed_layout, padding, row_layout
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

_FILLS = tuple(map(bytes, range(8)))
_GAPS = (b"", None, None, None, bytes(4))  # padding before numbers of 8 bytes: 0 or 4


def encoder_function(
    fields: Fields,
    form: str,
    join: Callable[[Iterable[Any]], Any] = b"".join,
    wire: WireProfile = CDR,
    *,
    omits_seq: bool = False,
) -> Callable[[Any], Any]:
    """The encoder; `form` is the form of the values: `none`, `one` or `tuple`.

    `join` makes the message of its parts. `omits_seq`: without the `seq` that the message starts
    with; the sender adds it.
    """
    writer = _Encoder(wire, omits_seq)
    writer.names["join"] = join
    writer.message(fields, form)

    def failed(values: Any, failure: Exception) -> Exception:
        return explain(fields, form, values, failure)

    writer.names["failed"] = failed
    tail = "    except Exception as e:\n        failure = e\n    raise failed(value, failure)"
    return writer.compiled("def encode(value):", tail, "encode")


def _packer(layout: struct.Struct) -> Callable[..., Any]:
    return layout.pack


class _Encoder(Emitter):
    """`parts` are the expressions for the pieces of the message that are not yet joined."""

    def __init__(self, wire: WireProfile, omits_seq: bool) -> None:
        super().__init__({"join": b"".join, "ndarray": np.ndarray, "as_array": as_array}, wire)
        self.omits_seq = omits_seq
        self.parts: list[str] = []
        self.spilled = False

    def message(self, fields: Fields, form: str) -> None:
        """The complete body."""
        if self.wire.header is not None:
            self.run.append(("I", str(self.wire.header)))
        names = ["value"]
        if form == "tuple":
            names = [self.name("a") for _ in fields]
            self.line(f"[{', '.join(names)}] = value")
        for name, (_, type_) in zip(names, fields, strict=False):
            self.value(type_, name)
        if not fields:
            self.pad_empty()
            if form == "none":
                self.line("if value is not None: raise TypeError")
        self.flush()
        if self.spilled:
            self.spill()
            self.line("return join(out)")
        elif len(self.parts) == 1 and self.parts[0].endswith(")"):  # packed, so bytes
            self.line(f"return {self.parts[0]}")
        else:
            self.line(f"return join(({''.join(f'{part}, ' for part in self.parts)}))")

    def flush(self) -> None:
        """Emit one `pack` for the pending numbers."""
        if not self.run:
            return
        values = ", ".join(value for _, value in self.run if value)
        call, at = self.take_run()
        expression = f"{call(_packer)}({values})"
        if at is None:  # the position advances before the pieces are joined
            part = self.name("t")
            self.line(f"{part} = {expression}")
            expression = part
        self.parts.append(expression)

    def spill(self) -> None:
        """Move the previous pieces into the list `out`, which loops extend."""
        parts, self.parts = ", ".join(self.parts), []
        if not self.spilled:
            self.line(f"out = [{parts}]")
        elif parts:
            self.line(f"out += ({parts},)")
        self.spilled = True

    def value(self, type_: Type, expression: str) -> None:
        """One value of any type."""
        match type_:
            case Primitive():
                self.primitive(type_, expression)
            case Array():
                self.array(type_, expression)
            case Sequence():
                self.sequence(type_, expression)
            case Dictionary():
                self.dictionary(type_, expression)
            case _ if issubclass(type_, Struct):
                self.record(type_, expression)
            case _ if issubclass(type_, Enum):
                values = {int(member): int(member) for member in type_}
                self.run.append(("i", f"{self.constant(values)}[{expression}]"))
            case _:
                self.struct_array(type_, expression)

    def primitive(self, type_: Primitive, expression: str) -> None:
        """A number, a bool or a string."""
        if type_.is_text:
            self.text(type_, expression)
        elif type_ is BOOL:
            self.run.append(("?", f"{self.constant(FLAGS)}[{expression}]"))
        else:
            self.run.append((type_.code, expression))

    def text(self, type_: Primitive, expression: str) -> None:
        """Length with the NUL, UTF-8; the NUL is packed with the next run."""
        text, length = self.name("s"), self.name("l")
        self.line(f"{text} = {expression}.encode()")
        self.line(f"{length} = len({text})")
        if type_.bound:
            self.line(f"if {length} > {type_.bound}: raise ValueError")
        terminated = self.wire.terminated
        self.run.append(("I", f"{length} + 1" if terminated else length))
        self.flush()
        self.parts.append(text)
        self.advance(length)
        if terminated:
            self.run.append(("x", ""))

    def record(self, type_: type[Struct], expression: str) -> None:
        """The fields in order."""
        if not type_._fields_:
            self.pad_empty()
            return
        is_first = self.at == 0 and not (self.run or self.parts)
        if self.wire.inserts_seq(type_) and not (self.omits_seq and is_first):
            self.run.append(("I", "0"))
        name = self.assigned("v", expression)
        for attribute, (_, inner) in zip(type_._names_, type_._fields_, strict=True):
            self.value(inner, f"{name}.{attribute}")

    def array(self, type_: Array, expression: str) -> None:
        """A numpy array; its memory is a piece of the message."""
        name, dtype = self.assigned("a", expression), type_.element.dtype
        kind, strides = self.constant(dtype), f"({dtype.itemsize},)"
        self.line(
            f"if {name}.__class__ is not ndarray or {name}.dtype is not {kind}"
            f" or {name}.strides != {strides}: {name} = as_array({name}, {kind})"
        )
        self.limit(type_, f"len({name})")
        if type_.size:
            self.fixed(name, type_.size, dtype.itemsize)
        else:
            self.block(name, dtype.itemsize, dtype.itemsize)

    def fixed(self, name: str, count: int, size: int) -> None:
        """The memory of a fixed array, after the padding that its elements need."""
        self.flush()
        if not self.is_aligned(size):
            if self.at is None:
                self.settle()
                gap = self.name("g")
                self.line(f"{gap} = -p & {size - 1}")
                self.parts.append(f"{self.constant(_FILLS)}[{gap}]")
                self.advance(gap)
                self.multiple = size
            else:
                gap_size = padding(self.at, size)
                self.parts.append(self.constant(_FILLS[gap_size]))
                self.skip(gap_size)
        self.parts.append(name)
        self.skip(count * size)

    def struct_array(self, type_: Any, expression: str) -> None:
        """A structured array, copied from memory if wire and memory layout are the same."""
        layout = row_layout(type_._element_)
        source, name, cls = self.assigned("a", expression), self.name("a"), self.constant(type_)
        self.line(
            f"{name} = {source}._array if {source}.__class__ is {cls} else {cls}._rows({source})"
        )
        if check := checker(layout):
            self.line(f"{self.constant(check)}({name})")
        packed = layout if self.wire.aligned else packed_layout(type_._element_)
        if packed.dtype != layout.dtype:
            self.line(f"{name} = {name}.astype({self.constant(packed.dtype)})")
        if packed.direct:
            self.line(f"if {name}.strides != ({packed.stride},): {name} = {name}.copy()")
            self.block(name, packed.stride, packed.alignment)
            return
        self.count(name)
        self.settle()
        piece = self.name("t")
        names = self.constant(layout), self.constant(pack)
        self.line(f"{piece} = {names[1]}({names[0]}, {name}, {self.variable})")
        self.parts.append(piece)
        self.advance(f"len({piece})")

    def count(self, name: str) -> str:
        """The number of elements."""
        count = self.name("n")
        self.line(f"{count} = len({name})")
        self.run.append(("I", count))
        self.flush()
        return count

    def block(self, name: str, size: int, alignment: int) -> None:
        """A count, and memory sent unchanged. An empty array has no padding before it."""
        count = self.count(name)
        alignment = self.wire.alignment(alignment)
        gaps = []
        if alignment == 8 and (self.at is None or self.at % 8):
            if self.at is None:
                self.settle()
            gap = self.name("g")
            self.line(f"{gap} = {count} and {4 if self.at is not None else 'p & 4'}")
            self.parts.append(f"{self.constant(_GAPS)}[{gap}]")
            gaps = [gap]
        self.parts.append(name)
        self.advance(*gaps, f"{count} * {size}")
        self.multiple = min(4, size & -size)

    def sequence(self, type_: Sequence, expression: str) -> None:
        """A list, element by element."""
        name, item = self.assigned("q", expression), self.name("e")
        items = self.constant(as_list)
        self.line(f"if {name}.__class__ is not list: {name} = {items}({name})")
        self.limit(type_, f"len({name})")
        if type_.size:
            self.flush()
        else:
            self.count(name)
        self.spill()
        self.loop(f"for {item} in {name}:", lambda: self.element(type_.element, item))

    def dictionary(self, type_: Dictionary, expression: str) -> None:
        """A dict, pair by pair."""
        name, key, item = self.assigned("q", expression), self.name("e"), self.name("e")
        self.count(name)
        self.spill()

        def pair() -> None:
            self.value(type_.key, key)
            self.element(type_.value, item)

        self.loop(f"for {key}, {item} in {name}.items():", pair)

    def element(self, type_: Type, name: str) -> None:
        """The last value of a loop's body."""
        self.value(type_, name)
        self.flush()
        self.spill()

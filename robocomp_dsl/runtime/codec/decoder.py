"""Generates decoders. In: a schema. Out: a Python function from bytes to values.

Generated decoders are fast and safe for any input: every `unpack` and slice fails on bytes that do
not fit. After a failure `read` decodes the message again: it raises a located `MalformedMessage`,
or returns the values of rare formats such as big-endian messages.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.emitter import Emitter
from robocomp_dsl.runtime.codec.read import read
from robocomp_dsl.runtime.codec.struct_arrays import checker, unpack
from robocomp_dsl.runtime.codec.wire_profile import (
    CDR,
    MAX_EMPTY_ELEMENTS,
    SEQ_BYTES,
    WireProfile,
)
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


def decoder_function(fields: Fields, form: str, wire: WireProfile = CDR) -> Callable[[Any], Any]:
    """The decoder; `form` is the form of the result: `none`, `one` or `tuple`."""
    compiled: list[Callable[[Any], Any]] = []

    def from_view(buffer: Any) -> Any:
        """Buffers other than bytes need their own decoder, because they have no `decode`."""
        if not compiled:
            compiled.append(_written(fields, form, wire, view=True))
        return compiled[0](memoryview(buffer).toreadonly().cast("B"))

    return _written(fields, form, wire, view=False, other=from_view)


def _written(
    fields: Fields, form: str, wire: WireProfile, *, view: bool, other: Any = None
) -> Callable[[Any], Any]:
    writer = _Decoder(wire, view)
    if not view:
        writer.names["other"] = other
        writer.line("if b.__class__ is not bytes: return other(b)")
    writer.message(fields, form)
    writer.names["read"] = partial(read, fields, form, wire=wire)
    tail = "    except Exception: pass\n    return read(b)"
    return writer.compiled("def decode(b):", tail, "decode")


def _unpacker(layout: struct.Struct) -> Callable[..., Any]:
    return layout.unpack_from


class _Decoder(Emitter):
    """`after` has the lines to emit after the numbers in `run` are unpacked."""

    variable = "o"

    def __init__(self, wire: WireProfile, view: bool) -> None:
        super().__init__({"ndarray": np.ndarray}, wire)
        self.origin = wire.start
        self.view = view
        self.after: list[str] = []

    def message(self, fields: Fields, form: str) -> None:
        """The complete body."""
        if self.wire.header is not None:
            self.line(f"if {self.number('I')} != {self.wire.header}: raise ValueError")
        values = [self.value(type_) for _, type_ in fields]
        if not fields:
            self.pad_empty()
        self.flush()
        end = "o"
        if self.at is not None:
            end = str(self.at + self.origin)
        else:
            self.settle()
        self.line(f"if len(b) != {end}: raise ValueError")
        if form == "tuple":
            self.line(f"return ({''.join(f'{value}, ' for value in values)})")
        else:
            self.line(f"return {values[0] if values else None}")

    def line(self, text: str) -> None:
        """Append a line, after the numbers that it may need."""
        if self.run:
            self.after.append(text)
        else:
            super().line(text)

    def number(self, code: str) -> str:
        """The variable of a number that is unpacked later."""
        name = self.name("n")
        self.run.append((code, name))
        return name

    def flush(self) -> None:
        """Emit one `unpack_from` for the pending numbers, then the pending lines."""
        if not self.run:
            return
        names = [name for _, name in self.run if name]
        call, at = self.take_run()
        where = "o" if at is None else str(at + self.origin)
        targets = f"({', '.join(names)},) = " if names else ""
        self.line(f"{targets}{call(_unpacker)}(b, {where})")
        after, self.after = self.after, []
        for line in after:
            self.line(line)

    def value(self, type_: Type) -> str:
        """One value of any type: an expression that may be used once."""
        match type_:
            case Primitive():
                value = self.primitive(type_)
            case Array():
                value = self.array(type_)
            case Sequence():
                value = self.sequence(type_)
            case Dictionary():
                value = self.dictionary(type_)
            case _ if issubclass(type_, Struct):
                value = self.record(type_)
            case _ if issubclass(type_, Enum):
                members = {int(member): member for member in type_}
                value = f"{self.constant(members)}[{self.number('i')}]"
            case _:
                value = self.struct_array(type_)
        return value

    def primitive(self, type_: Primitive) -> str:
        """A number, a bool or a string."""
        if type_.is_text:
            return self.text(type_)
        if type_ is BOOL:
            return f"{self.constant((False, True))}[{self.number('B')}]"
        return self.number(type_.code)

    def start(self) -> str:
        """Offset of the next byte in the buffer: a number or the variable."""
        self.flush()
        if self.at is not None:
            return str(self.at + self.origin)
        self.settle()
        return "o"

    def text(self, type_: Primitive) -> str:
        """Length, UTF-8, NUL. Some peers write an empty string as length 0.

        Without NUL a slice beyond the end is short; the end of the message shows it.
        """
        length, text, end = self.number("I"), self.name("s"), self.name("e")
        start = self.start()
        nul = int(self.wire.terminated)
        if type_.bound:
            self.line(f"if {length} > {type_.bound + nul}: raise ValueError")
        if nul:
            self.line(f"{end} = {start} + {length} - 1")
            self.line(f"if b[{end}]: raise ValueError")
        else:
            self.line(f"{end} = {start} + {length}")
        cut = f"b[{start}:{end}]"
        self.line(f"{text} = " + (f"str({cut}, 'utf-8')" if self.view else f"{cut}.decode()"))
        self.advance()
        self.later = [f"{end} + 1" if nul else end]
        self._unset = True
        return text

    def record(self, type_: type[Struct]) -> str:
        """An object, created without calling `__init__`, which would only set defaults."""
        if not type_._fields_:
            self.pad_empty()
        if self.wire.inserts_seq(type_):
            self.run += [("x", "")] * SEQ_BYTES
        values = [self.value(inner) for _, inner in type_._fields_]
        name = self.name("v")
        self.line(f"{name} = {self.constant(type_.__new__)}({self.constant(type_)})")
        for attribute, value in zip(type_._names_, values, strict=True):
            self.line(f"{name}.{attribute} = {value}")
        return name

    def array(self, type_: Array) -> str:
        """A view of the message."""
        primitive = type_.element
        dtype = np.dtype(np.uint8) if primitive is BOOL else primitive.dtype
        if type_.size:
            name = self.fixed(dtype, type_.size)
        else:
            name = self.block(dtype, primitive.size, primitive.size, type_)
        if primitive is BOOL:
            self.line(f"{name} = {self.constant(flags)}({name})")
        return name

    def fixed(self, dtype: np.dtype[Any], count: int) -> str:
        """A known number of elements in numpy's memory layout."""
        size, name = dtype.itemsize, self.name("a")
        self.start()
        if not self.is_aligned(size):
            if self.at is None:
                self.line(f"o += {self.origin} - o & {size - 1}")
                self.multiple = size
            else:
                self.skip(padding(self.at, size))
        start = self.start()
        self.line(f"{name} = ndarray({count}, {self.constant(dtype)}, b, {start})")
        self.skip(count * size)
        return name

    def block(
        self, dtype: np.dtype[Any], size: int, alignment: int, type_: Array | None = None
    ) -> str:
        """A count, and as many elements in numpy's memory layout."""
        count, name = self.number("I"), self.name("a")
        alignment = self.wire.alignment(alignment)
        start = self.start()
        if type_:
            self.limit(type_, count)
        if alignment == 8:
            self.settle()
            start = "o"
            self.line(f"if {count} and not o & 4: o += 4")
        self.line(f"{name} = ndarray({count}, {self.constant(dtype)}, b, {start})")
        self.advance(f"{count} * {size}")
        self.multiple = min(4, size & -size)
        return name

    def struct_array(self, type_: Any) -> str:
        """A structured array: a view of the message if wire and memory layout are the same."""
        layout = row_layout(type_._element_)
        packed = layout if self.wire.aligned else packed_layout(type_._element_)
        if packed.direct:
            name = self.block(packed.dtype, packed.stride, packed.alignment)
            if packed.dtype != layout.dtype:
                self.line(f"{name} = {name}.astype({self.constant(layout.dtype)})")
                self.line(f"{name}.flags.writeable = False")
        else:
            count, name = self.number("I"), self.name("a")
            self.start()
            self.settle()
            names = self.constant(unpack), self.constant(layout)
            self.line(f"{name}, o = {names[0]}({names[1]}, b, o, {count})")
        if check := checker(layout):
            self.line(f"{self.constant(check)}({name})")
        view = self.name("v")
        self.line(f"{view} = {self.constant(type_.__new__)}({self.constant(type_)})")
        self.line(f"{view}._array = {view}._store = {name}")
        return view

    def sequence(self, type_: Sequence) -> str:
        """A list. It grows with the decoded elements, independent of the transmitted count."""
        count = str(type_.size) if type_.size else self.number("I")
        name = self.name("q")
        self.flush()
        if not type_.size:
            self.limit(type_, count)
            if not self.wire.pads_empty:
                self.line(f"if {count} > len(b) + {MAX_EMPTY_ELEMENTS}: raise ValueError")
        self.line(f"{name} = []")

        def body() -> None:
            self.line(f"{name}.append({self.value(type_.element)})")

        self.loop(f"for _ in range({count}):", body)
        return name

    def dictionary(self, type_: Dictionary) -> str:
        """A dict; of duplicate keys the last one is used."""
        count, name = self.number("I"), self.name("q")
        self.flush()
        self.line(f"{name} = {{}}")

        def body() -> None:
            key, value = self.value(type_.key), self.value(type_.value)
            self.line(f"{name}[{key}] = {value}")

        self.loop(f"for _ in range({count}):", body)
        return name


def flags(array: np.ndarray[Any, np.dtype[np.uint8]]) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Bytes as bools. Raises `ValueError` for other bytes than 0 and 1."""
    if array.size and array.max() > 1:
        raise ValueError
    return array.view(np.bool_)

"""Writes decoders. In: a schema. Out: a Python function from bytes to values.

What it makes is fast and trusts nothing: every number is unpacked and every slice taken in a way
that fails on bytes that do not fit. Any failure hands the message to `read`, which either has an
explanation (`MalformedMessage`) or reads what is rare, as messages of big-endian peers.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.emitter import HEADER, Emitter
from robocomp_dsl.runtime.codec.read import read
from robocomp_dsl.runtime.codec.struct_arrays import checker, unpack
from robocomp_dsl.runtime.data.layout import row_layout
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    STRING,
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct


def decoder_function(fields: Fields, form: str) -> Callable[[Any], Any]:
    """The decoder; `form` says how the values are handed over: `none`, `one` or `tuple`."""
    compiled: list[Callable[[Any], Any]] = []

    def from_view(buffer: Any) -> Any:
        """Buffers other than bytes have a decoder of their own, for they have no `decode`."""
        if not compiled:
            compiled.append(_written(fields, form, view=True))
        return compiled[0](memoryview(buffer).toreadonly().cast("B"))

    return _written(fields, form, view=False, other=from_view)


def _written(fields: Fields, form: str, view: bool, other: Any = None) -> Callable[[Any], Any]:
    writer = _Decoder(view)
    if not view:
        writer.names["other"] = other
        writer.line("if b.__class__ is not bytes: return other(b)")
    writer.message(fields, form)
    writer.names["read"] = partial(read, fields, form)
    tail = "    except Exception: pass\n    return read(b)"
    return writer.compiled("def decode(b):", tail, "decode")


def _unpacker(layout: struct.Struct) -> Callable[..., Any]:
    return layout.unpack_from


class _Decoder(Emitter):
    """`after` are the lines that wait, with the numbers in `run`, for being unpacked."""

    variable = "o"
    origin = 4

    def __init__(self, view: bool) -> None:
        super().__init__({"ndarray": np.ndarray})
        self.view = view
        self.after: list[str] = []

    def message(self, fields: Fields, form: str) -> None:
        """The whole body."""
        self.line(f"if {self.number('I')} != {HEADER}: raise ValueError")
        values = [self.value(type_) for _, type_ in fields]
        if not fields:
            self.run.append(("x", ""))
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
        """Add a line, behind the numbers that it may need."""
        if self.run:
            self.after.append(text)
        else:
            super().line(text)

    def number(self, code: str) -> str:
        """The variable of a number that is yet to be unpacked."""
        name = self.name("n")
        self.run.append((code, name))
        return name

    def flush(self) -> None:
        """One `unpack_from` for the numbers that wait, then the lines that wait for them."""
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
        """One value of any type: an expression for it, to be used once."""
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
        """A number, a bool or a text."""
        if type_ is STRING:
            return self.text()
        if type_ is BOOL:
            return f"{self.constant((False, True))}[{self.number('B')}]"
        return self.number(type_.code)

    def start(self) -> str:
        """Where the next byte lies in the buffer: a number or the variable."""
        self.flush()
        if self.at is not None:
            return str(self.at + self.origin)
        self.settle()
        return "o"

    def text(self) -> str:
        """Length, UTF-8, NUL. Length 0, which some peers write, is an empty text, too."""
        length, text, end = self.number("I"), self.name("s"), self.name("e")
        start = self.start()
        self.line(f"{end} = {start} + {length} - 1")
        self.line(f"if b[{end}]: raise ValueError")
        cut = f"b[{start}:{end}]"
        self.line(f"{text} = " + (f"str({cut}, 'utf-8')" if self.view else f"{cut}.decode()"))
        self.advance()
        self.later = [f"{end} + 1"]
        self._unset = True
        return text

    def record(self, type_: type[Struct]) -> str:
        """An object, made past its `__init__`, which would only fill in defaults."""
        if not type_._fields_:
            self.run.append(("x", ""))
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
        name = self.block(dtype, primitive.size, primitive.size)
        if primitive is BOOL:
            self.line(f"{name} = {self.constant(flags)}({name})")
        return name

    def block(self, dtype: np.dtype[Any], size: int, alignment: int) -> str:
        """A count and that many elements that lie as numpy has them."""
        count, name = self.number("I"), self.name("a")
        start = self.start()
        if alignment == 8:
            self.settle()
            start = "o"
            self.line(f"if {count} and not o & 4: o += 4")
        self.line(f"{name} = ndarray({count}, {self.constant(dtype)}, b, {start})")
        self.advance(f"{count} * {size}")
        self.multiple = min(4, size & -size)
        return name

    def struct_array(self, type_: Any) -> str:
        """A structured array: a view of the message if the wire has it as memory does."""
        layout = row_layout(type_._element_)
        if layout.direct:
            name = self.block(layout.dtype, layout.stride, layout.alignment)
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
        """A list. It grows as elements are found, never by what its count claims."""
        count, name = self.number("I"), self.name("q")
        self.flush()
        self.line(f"{name} = []")

        def body() -> None:
            self.line(f"{name}.append({self.value(type_.element)})")

        self.loop(f"for _ in range({count}):", body)
        return name

    def dictionary(self, type_: Dictionary) -> str:
        """A dict; of equal keys the last one counts."""
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

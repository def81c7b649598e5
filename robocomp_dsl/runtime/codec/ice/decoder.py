"""Generates decoders of Ice's wire format. In: a schema. Out: a Python function from bytes.

Generated decoders are fast and safe for any input: bytes that do not fit raise somewhere, at the
latest in the comparison of the end with the length of the message. After a failure `read` decodes
the message again and raises a located `MalformedMessage`.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.decoder import flags
from robocomp_dsl.runtime.codec.ice import rows, wire
from robocomp_dsl.runtime.codec.ice.read import read
from robocomp_dsl.runtime.codec.source_writer import SourceWriter
from robocomp_dsl.runtime.codec.struct_arrays import checker
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


def decoder_function(fields: Fields, form: str, order: tuple[int, ...]) -> Callable[[bytes], Any]:
    """The decoder; `form` is the form of the result: `none`, `one` or `tuple`.

    `order` are the indices of the fields in their order on the wire.
    """
    writer = _Decoder()
    writer.message(fields, form, order)
    writer.names["read"] = partial(read, fields, form, order)
    return writer.compiled(
        "def decode(b):", "    except Exception: pass\n    return read(b)", "decode"
    )


class _Decoder(SourceWriter):
    """`at` is the offset if it is known when the code is generated, else the variable `o` has it.

    `run` are the numbers to unpack next, `after` the lines that may need them.
    """

    def __init__(self) -> None:
        super().__init__({"ndarray": np.ndarray, "large": struct.Struct("<I").unpack_from})
        self.at: int | None = 0
        self.run: list[tuple[str, str]] = []
        self.after: list[str] = []

    def message(self, fields: Fields, form: str, order: tuple[int, ...]) -> None:
        """The complete body."""
        self.line(f"if {self.number('i')} != len(b): raise ValueError")
        self.line(f"if {self.number('H')} != {wire.VERSION}: raise ValueError")
        values = [""] * len(fields)
        for index in order:
            values[index] = self.value(fields[index][1])
        self.flush()
        self.line(f"if len(b) != {self.offset}: raise ValueError")
        if form == "tuple":
            self.line(f"return ({''.join(f'{value}, ' for value in values)})")
        else:
            self.line(f"return {values[0] if values else None}")

    @property
    def offset(self) -> str:
        """The offset of the next byte."""
        return "o" if self.at is None else str(self.at)

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
        layout = struct.Struct("<" + "".join(code for code, _ in self.run))
        names = [name for _, name in self.run if name]
        self.run = []
        targets = f"({', '.join(names)},) = " if names else ""
        self.line(f"{targets}{self.constant(layout.unpack_from)}(b, {self.offset})")
        if self.at is None:
            self.line(f"o += {layout.size}")
        else:
            self.at += layout.size
        after, self.after = self.after, []
        for line in after:
            self.line(line)

    def settle(self) -> None:
        """Have the offset in the variable."""
        self.flush()
        if self.at is not None:
            self.line(f"o = {self.at}")
            self.at = None

    def size(self) -> str:
        """The variable of a size."""
        self.settle()
        name = self.name("n")
        self.line(f"{name} = b[o]")
        self.line("o += 1")
        self.line(f"if {name} == 255: ({name},) = large(b, o); o += 4")
        return name

    def value(self, type_: Type) -> str:
        """One value of any type: an expression that may be used once."""
        match type_:
            case Primitive():
                value = self.primitive(type_)
            case Array():
                value = self.array(type_)
            case Sequence():
                value = self.sequence(type_.element, type_)
            case Dictionary():
                value = self.dictionary(type_)
            case _ if issubclass(type_, Struct):
                value = self.record(type_)
            case _ if issubclass(type_, Enum):
                number = self.number("B") if rows.is_one_byte(type_) else self.size()
                members = {int(member): member for member in type_}
                value = f"{self.constant(members)}[{number}]"
            case _:
                value = self.struct_array(type_)
        return value

    def primitive(self, type_: Primitive) -> str:
        """A number, a bool or a string."""
        if type_.is_text:
            return self.text(type_.bound)
        if type_ is BOOL:
            return f"{self.constant((False, True))}[{self.number('B')}]"
        return self.number(type_.code)

    def text(self, bound: int) -> str:
        """Size and UTF-8. A slice beyond the end is short; the end of the message shows it."""
        size, text = self.size(), self.name("s")
        if bound:
            self.line(f"if {size} > {bound}: raise ValueError")
        self.line(f"{text} = b[o:o + {size}].decode()")
        self.line(f"o += {size}")
        return text

    def record(self, type_: type[Struct]) -> str:
        """An object, created without calling `__init__`, which would only set defaults."""
        if not type_._fields_ and not issubclass(type_, DeclaredError):
            self.run.append(("x", ""))
        values = [self.value(inner) for _, inner in type_._fields_]
        name = self.name("v")
        self.line(f"{name} = {self.constant(type_.__new__)}({self.constant(type_)})")
        for attribute, value in zip(type_._names_, values, strict=True):
            self.line(f"{name}.{attribute} = {value}")
        return name

    def array(self, type_: Array) -> str:
        """A view of the message, or a copy if its memory is not aligned."""
        primitive = type_.element
        dtype = np.dtype(np.uint8) if primitive is BOOL else primitive.dtype
        count, name = self.size(), self.name("a")
        self.limit(type_, count)
        self.line(f"{name} = ndarray({count}, {self.constant(dtype)}, b, o)")
        self.line(f"o += {count} * {primitive.size}")
        if primitive.size > 1:
            self.line(f"{name} = {self.constant(rows.aligned)}({name})")
        if primitive is BOOL:
            self.line(f"{name} = {self.constant(flags)}({name})")
        return name

    def struct_array(self, type_: Any) -> str:
        """A structured array."""
        packed = rows.packed_rows(type_._element_)
        if packed is None:
            items = self.sequence(type_._element_)
            return f"{self.constant(type_)}({items})"
        count, name = self.size(), self.name("a")
        names = self.constant(rows.unpack), self.constant(packed)
        self.line(f"{name} = {names[0]}({names[1]}, b, o, {count})")
        self.line(f"o += {count} * {packed.dtype.itemsize}")
        if check := checker(row_layout(type_._element_)):
            self.line(f"{self.constant(check)}({name})")
        return f"{self.constant(type_._over)}({name})"

    def sequence(self, element: Type, type_: Sequence | None = None) -> str:
        """A list. It grows with the decoded elements, independent of the transmitted count."""
        count, name = self.size(), self.name("q")
        if type_:
            self.limit(type_, count)
        self.line(f"{name} = []")

        def body() -> None:
            self.line(f"{name}.append({self.value(element)})")
            self.flush()

        self.nested(f"for _ in range({count}):", body)
        return name

    def dictionary(self, type_: Dictionary) -> str:
        """A dict; of duplicate keys the last one is used."""
        count, name = self.size(), self.name("q")
        self.line(f"{name} = {{}}")

        def body() -> None:
            key, value = self.value(type_.key), self.value(type_.value)
            self.line(f"{name}[{key}] = {value}")
            self.flush()

        self.nested(f"for _ in range({count}):", body)
        return name

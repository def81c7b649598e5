"""Shared by the generators of encoders and decoders: source lines, constants, and the position.

In: the items of a message in order. Out: the source of a function and the names it uses.

Adjacent numbers become one call of a `struct.Struct` that includes the padding between them. If
their start is known only at run time, there is one such `Struct` for each residue. Positions count
from the end of the encapsulation header, like alignment.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from typing import Any

from robocomp_dsl.runtime.codec.source_writer import SourceWriter
from robocomp_dsl.runtime.codec.wire_profile import CDR, WireProfile
from robocomp_dsl.runtime.data.layout import padding

SIZES = {
    **dict.fromkeys("x?bB", 1),
    **dict.fromkeys("hH", 2),
    **dict.fromkeys("iIf", 4),
    **dict.fromkeys("qQd", 8),
}
"""Size and alignment of each `struct` letter; x is a padding byte."""


def numbers(codes: Iterable[str], start: int, wire: WireProfile = CDR) -> struct.Struct:
    """The format of adjacent numbers if the first one's padding starts at `start`."""
    form, at = "<", start
    for code in codes:
        gap = padding(at, wire.alignment(SIZES[code]))
        form += "x" * gap + code
        at += gap + SIZES[code]
    return struct.Struct(form)


class Emitter(SourceWriter):
    """A function under construction.

    `at` is the position if it is known at generation time; else it is the variable `variable` plus
    `origin` once `settle` has emitted the increments in `later`, and is a multiple of
    `multiple`. Subclasses emit the pending numbers in `run` with `flush`.
    """

    variable = "p"
    origin = 0

    def __init__(self, names: dict[str, Any], wire: WireProfile = CDR) -> None:
        super().__init__(names)
        self.wire = wire
        self.at: int | None = -wire.start
        self.multiple = 1
        self.later: list[str] = []
        self.run: list[tuple[str, str]] = []
        self._unset = True

    def flush(self) -> None:
        """Emit the numbers in `run`."""
        raise NotImplementedError

    def pad_empty(self) -> None:
        """A struct without fields."""
        if self.wire.pads_empty:
            self.run.append(("x", ""))

    def take_run(self) -> tuple[Callable[[Callable[..., Any]], str], int | None]:
        """End the run: the expression for its `Struct` method, and the position.

        The second is the position if it is known. The increment of the position is recorded.
        """
        codes = [code for code, _ in self.run]
        self.run = []
        if self.at is not None:
            here, layout = self.at, numbers(codes, self.at, self.wire)
            self.at += layout.size
            return lambda pick: self.constant(pick(layout)), here
        alignment = max(self.wire.alignment(SIZES[code]) for code in codes)
        known = self.multiple >= alignment
        layout = numbers(codes, 0, self.wire)
        # After the widest number the residue is independent of the start.
        self.multiple = min(alignment, layout.size & -layout.size)
        self.settle()
        if known:
            self.later.append(str(layout.size))
            return lambda pick: self.constant(pick(layout)), None
        residues = [numbers(codes, (r - self.origin) % alignment) for r in range(alignment)]
        index = f"[{self.variable} & {alignment - 1}]"
        self.later.append(self.constant(tuple(s.size for s in residues)) + index)
        return lambda pick: self.constant(tuple(map(pick, residues))) + index, None

    def advance(self, *sizes: str) -> None:
        """Advance by sizes known only at run time; the position after them is unknown."""
        if self.at is not None:
            self.later = [str(self.at + self.origin)]
            self.at = None
            self._unset = True
        self.later.extend(sizes)
        self.multiple = 1

    def skip(self, size: int) -> None:
        """Advance by a size known now; the position after it stays as known as before."""
        if self.at is not None:
            self.at += size
        else:
            self.later.append(str(size))
            self.multiple = min(self.multiple, size & -size)

    def is_aligned(self, alignment: int) -> bool:
        """Whether the position is known to be a multiple of `alignment`, if that matters."""
        if not self.wire.aligned:
            return True
        known = self.multiple if self.at is None else self.at & -self.at or alignment
        return known >= alignment

    def settle(self) -> None:
        """Update the variable."""
        if self.at is not None:
            self.advance()
        if self.later:
            operator = "=" if self._unset else "+="
            self.line(f"{self.variable} {operator} {' + '.join(self.later)}")
        self._unset = False
        self.later = []

    def loop(self, head: str, body: Callable[[], None]) -> None:
        """A loop; the position inside and after it is unknown."""
        self.settle()
        self.multiple = 1

        def counted() -> None:
            body()
            self.flush()
            self.settle()

        self.nested(head, counted)
        self.multiple = 1

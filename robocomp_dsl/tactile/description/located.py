"""YAML read with places, so that every complaint names its line and column.

In: a text. Out: `Entry` trees that hand out tables, lists, numbers and words. What is wrong is
collected in `Reading.findings` and a harmless value is returned, so that reading goes on and all
faults are told at once. A length or an angle may carry a unit: `90 deg`, `62.5 mm`; rad and m are
meant else.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

import yaml

from robocomp_dsl.tactile.errors import DescriptionError, Fault, Finding

UNITS = {"deg": math.pi / 180.0, "rad": 1.0, "mm": 0.001, "m": 1.0}
UNITS_OF = {"a number": (), "an angle": ("deg", "rad"), "a length": ("mm", "m")}
NUMBER, ANGLE, LENGTH = UNITS_OF
_QUANTITY = re.compile(r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(deg|rad|mm|m)?")


def meant_in_degrees(value: float, largest: float) -> str:
    """The end of a sentence where `value` [rad] is too much, and would not be in degrees."""
    fits = abs(value) > 2 * math.pi and abs(value) * UNITS["deg"] <= largest
    return f"; is it meant in degrees? write `{value:g} deg`" if fits else ""


@dataclass(slots=True)
class Reading:
    """One file being read, and what was found wrong so far."""

    file: Path
    findings: list[Finding] = field(default_factory=list)

    def root(self, text: str) -> Entry:
        """The whole document. Raises `DescriptionError` when it is not YAML."""
        try:
            node = yaml.compose(text, Loader=yaml.SafeLoader)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
            said = f"this is not YAML: {error.problem or error.context}"
            raise DescriptionError([Finding(str(self.file), line, column, said)]) from None
        except yaml.YAMLError as error:
            raise DescriptionError([Finding(str(self.file), 1, 1, str(error))]) from None
        if node is None:
            raise DescriptionError([Finding(str(self.file), 1, 1, "the file is empty")])
        return Entry(self, node)

    def finish(self) -> None:
        """Raise `DescriptionError` if anything was found."""
        if self.findings:
            raise DescriptionError(self.findings)


@dataclass(frozen=True, slots=True)
class Place:
    """Where something stands in its file, from 1."""

    line: int
    column: int


NOWHERE = Place(1, 1)


@dataclass(frozen=True, slots=True)
class Entry:
    """One value of the file."""

    reading: Reading
    node: yaml.Node

    @property
    def place(self) -> Place:
        """Line and column of its first character."""
        return Place(self.node.start_mark.line + 1, self.node.start_mark.column + 1)

    def complain(self, message: str, help: str = "", fault: Fault = Fault.FORM) -> None:
        """Note a fault of this value."""
        file, place = str(self.reading.file), self.place
        self.reading.findings.append(Finding(file, place.line, place.column, message, help, fault))

    def table(self) -> Table:
        """The value as a table; an empty one after a complaint."""
        rows: dict[str, Entry] = {}
        if not isinstance(self.node, yaml.MappingNode):
            self.complain("a table of `key: value` is needed here")
            return Table(self, rows)
        for key, value in self.node.value:
            name = Entry(self.reading, key)
            if not isinstance(key, yaml.ScalarNode):
                name.complain("a key is a word")
            elif key.value in rows:
                name.complain(f"`{key.value}` is given twice")
            else:
                rows[key.value] = Entry(self.reading, value)
        return Table(self, rows)

    def items(self, count: int | None = None) -> list[Entry]:
        """The value as a list, of `count` entries if given; an empty one after a complaint."""
        if not isinstance(self.node, yaml.SequenceNode):
            self.complain("a list is needed here")
            return []
        if count is not None and len(self.node.value) != count:
            there = len(self.node.value)
            are = "is" if there == 1 else "are"
            self.complain(f"{count} entries are needed, there {are} {there}")
            return []
        return [Entry(self.reading, node) for node in self.node.value]

    def text(self) -> str:
        """The value as a word; an empty one after a complaint."""
        if isinstance(self.node, yaml.ScalarNode) and self.node.value:
            return str(self.node.value)
        self.complain("a word is needed here")
        return ""

    def number(self, what: str, counted: str = "") -> float:
        """The value, `what` of `UNITS_OF`; 0 after a complaint.

        In SI units, or as something that is `counted` in this unit has it; then so is a number that
        carries none.
        """
        match = None
        if isinstance(self.node, yaml.ScalarNode):
            match = _QUANTITY.fullmatch(self.node.value.strip())
        try:
            value = float(match[1]) if match else math.nan
        except ValueError:
            value = math.nan
        unit, units = match[2] if match else None, UNITS_OF[what]
        allowed = f"a unit may follow: {', '.join(units)}" if units else "without a unit"
        if not math.isfinite(value):
            self.complain(f"{what} is needed here", allowed)
            return 0.0
        if unit is None:
            return value
        if unit not in units:
            self.complain(f"{what} is needed here, and `{unit}` is no unit of one", allowed)
        return value * UNITS[unit] / UNITS[counted or "m"]

    def integer(self) -> int:
        """The value as a whole number; 0 after a complaint."""
        value = self.number(NUMBER)
        if value != int(value):
            self.complain("a whole number is needed here")
        return int(value)

    def numbers(self, what: tuple[str, ...], counted: str = "") -> tuple[float, ...]:
        """A list of as many numbers as `what` has entries; zeros after a complaint."""
        items = self.items(len(what))
        found = (item.number(one, counted) for item, one in zip(items, what, strict=False))
        return tuple(found) or (0.0,) * len(what)


@dataclass(slots=True)
class Table:
    """The keys of a table. `finish` complains about those that nobody asked for."""

    entry: Entry
    rows: dict[str, Entry]
    asked: set[str] = field(default_factory=set)

    def get(self, key: str) -> Entry | None:
        """The value of `key`, or None."""
        self.asked.add(key)
        return self.rows.get(key)

    def need(self, key: str) -> Entry | None:
        """The value of `key`; a complaint and None without it."""
        found = self.get(key)
        if found is None:
            self.entry.complain(f"`{key}` is missing here")
        return found

    def number(self, key: str, what: str, default: float | None = None, counted: str = "") -> float:
        """The number at `key`; without a default it must be there."""
        found = self.need(key) if default is None else self.get(key)
        return found.number(what, counted) if found else default or 0.0

    def text(self, key: str, default: str | None = None) -> str:
        """The word at `key`; without a default it must be there."""
        found = self.need(key) if default is None else self.get(key)
        return found.text() if found else default or ""

    def numbers(
        self, key: str, what: tuple[str, ...], default: tuple[float, ...] = (), counted: str = ""
    ) -> tuple[float, ...]:
        """The list of numbers at `key`; without a default it must be there."""
        found = self.get(key) if default else self.need(key)
        return found.numbers(what, counted) if found else default or (0.0,) * len(what)

    def finish(self) -> None:
        """Complain about keys that mean nothing here, naming the nearest that does."""
        for key, value in self.rows.items():
            if key not in self.asked:
                near = get_close_matches(key, self.asked, n=1)
                meant = f"did you mean `{near[0]}`?" if near else ""
                value.complain(f"`{key}` means nothing here", meant)

"""Read YAML with positions, so that every finding has a line and a column.

In: a text. Out: `Value` trees with tables, lists, numbers and strings. Errors are collected as
findings, and a neutral value is returned, so that reading continues and all errors are reported
together. A length or an angle may have a unit: `90 deg`, `62.5 mm`; the default is rad and m.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

import yaml

from robocomp_dsl.finding import NOWHERE, Finding, Location, SourceText
from robocomp_dsl.tactile.errors import DescriptionError, Fault

UNITS = {"deg": math.pi / 180.0, "rad": 1.0, "mm": 0.001, "m": 1.0}
UNITS_OF = {"a number": (), "an angle": ("deg", "rad"), "a length": ("mm", "m")}
NUMBER, ANGLE, LENGTH = UNITS_OF
_QUANTITY = re.compile(r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(deg|rad|mm|m)?")


def degrees_hint(value: float, largest: float) -> str:
    """A hint for a `value` [rad] that is too large but would fit as degrees; empty otherwise."""
    fits = abs(value) > 2 * math.pi and abs(value) * UNITS["deg"] <= largest
    return f"; if it is in degrees, write `{value:g} deg`" if fits else ""


@dataclass(slots=True)
class YamlReader:
    """One file being read, and its findings so far."""

    file: Path
    findings: list[Finding] = field(default_factory=list)
    text: SourceText = NOWHERE.text

    def root(self, text: str) -> YamlValue:
        """The whole document. Raises `DescriptionError` when it is not YAML."""
        self.text = SourceText.of_text(self.file, text)
        try:
            node = yaml.compose(text, Loader=yaml.SafeLoader)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
            message = f"invalid YAML: {error.problem or error.context}"
            raise DescriptionError([self.finding(line, column, message)]) from None
        except yaml.YAMLError as error:
            raise DescriptionError([self.finding(1, 1, str(error))]) from None
        if node is None:
            raise DescriptionError([self.finding(1, 1, "the file is empty")])
        return YamlValue(self, node)

    def finding(self, line: int, column: int, message: str) -> Finding:
        """A finding about the form of the file."""
        return Finding(self.text.word_at(line, column), message, kind=Fault.FORM)

    def finish(self) -> None:
        """Raise `DescriptionError` if there are findings."""
        if self.findings:
            raise DescriptionError(self.findings)


@dataclass(frozen=True, slots=True)
class YamlValue:
    """One value of the file."""

    reader: YamlReader
    node: yaml.Node

    @property
    def place(self) -> Location:
        """The location of its first word."""
        mark = self.node.start_mark
        return self.reader.text.word_at(mark.line + 1, mark.column + 1)

    def report(self, message: str, help: str = "", fault: Fault = Fault.FORM) -> None:
        """Report an error of this value."""
        self.reader.findings.append(Finding(self.place, message, help=help, kind=fault))

    def table(self) -> YamlTable:
        """The value as a table; an empty one, with a finding, if it is not a table."""
        rows: dict[str, YamlValue] = {}
        if not isinstance(self.node, yaml.MappingNode):
            self.report("expected a table of `key: value`")
            return YamlTable(self, rows)
        for key, value in self.node.value:
            name = YamlValue(self.reader, key)
            if not isinstance(key, yaml.ScalarNode):
                name.report("a key must be a scalar")
            elif key.value in rows:
                name.report(f"`{key.value}` is set twice")
            else:
                rows[key.value] = YamlValue(self.reader, value)
        return YamlTable(self, rows)

    def items(self, count: int | None = None) -> list[YamlValue]:
        """The value as a list of `count` entries (or any number); empty, with a finding, if not."""
        if not isinstance(self.node, yaml.SequenceNode):
            self.report("expected a list")
            return []
        if count is not None and len(self.node.value) != count:
            there = len(self.node.value)
            are = "is" if there == 1 else "are"
            self.report(f"{count} entries are needed, there {are} {there}")
            return []
        return [YamlValue(self.reader, node) for node in self.node.value]

    def text(self) -> str:
        """The value as a string; an empty one, with a finding, if it is not a string."""
        if isinstance(self.node, yaml.ScalarNode) and self.node.value:
            return str(self.node.value)
        self.report("expected a string")
        return ""

    def number(self, quantity: str, default_unit: str = "") -> float:
        """The value as a `quantity` of `UNITS_OF`; 0, with a finding, if it is invalid.

        In SI units, or in `default_unit` if set; a number without a unit is in the same unit.
        """
        match = None
        if isinstance(self.node, yaml.ScalarNode):
            match = _QUANTITY.fullmatch(self.node.value.strip())
        try:
            value = float(match[1]) if match else math.nan
        except ValueError:
            value = math.nan
        unit, units = match[2] if match else None, UNITS_OF[quantity]
        allowed = f"a unit may follow: {', '.join(units)}" if units else "without a unit"
        if not math.isfinite(value):
            self.report(f"{quantity} is expected here", allowed)
            return 0.0
        if unit is None:
            return value
        if unit not in units:
            self.report(f"{quantity} cannot have the unit `{unit}`", allowed)
        return value * UNITS[unit] / UNITS[default_unit or "m"]

    def integer(self) -> int:
        """The value as an integer; 0, with a finding, if it is not an integer."""
        value = self.number(NUMBER)
        if value != int(value):
            self.report("expected an integer")
        return int(value)

    def numbers(self, quantities: tuple[str, ...], default_unit: str = "") -> tuple[float, ...]:
        """A list with one number per entry of `quantities`; zeros, with a finding, if invalid."""
        items = self.items(len(quantities))
        values = (
            item.number(quantity, default_unit)
            for item, quantity in zip(items, quantities, strict=False)
        )
        return tuple(values) or (0.0,) * len(quantities)


@dataclass(slots=True)
class YamlTable:
    """The keys of a table. `finish` reports the keys that were not requested."""

    value: YamlValue
    rows: dict[str, YamlValue]
    requested: set[str] = field(default_factory=set)

    def get(self, key: str) -> YamlValue | None:
        """The value of `key`, or None."""
        self.requested.add(key)
        return self.rows.get(key)

    def require(self, key: str) -> YamlValue | None:
        """The value of `key`; None, with a finding, if it is missing."""
        value = self.get(key)
        if value is None:
            self.value.report(f"`{key}` is missing here")
        return value

    def number(
        self, key: str, quantity: str, default: float | None = None, default_unit: str = ""
    ) -> float:
        """The number at `key`; the key is required unless there is a default."""
        value = self.require(key) if default is None else self.get(key)
        return value.number(quantity, default_unit) if value else default or 0.0

    def text(self, key: str, default: str | None = None) -> str:
        """The string at `key`; the key is required unless there is a default."""
        value = self.require(key) if default is None else self.get(key)
        return value.text() if value else default or ""

    def numbers(
        self,
        key: str,
        quantities: tuple[str, ...],
        default: tuple[float, ...] = (),
        default_unit: str = "",
    ) -> tuple[float, ...]:
        """The list of numbers at `key`; required unless there is a default."""
        value = self.get(key) if default else self.require(key)
        return (
            value.numbers(quantities, default_unit)
            if value
            else default or (0.0,) * len(quantities)
        )

    def finish(self) -> None:
        """Report unknown keys, each with the most similar known key."""
        for key, value in self.rows.items():
            if key not in self.requested:
                near = get_close_matches(key, self.requested, n=1)
                meant = f"did you mean `{near[0]}`?" if near else ""
                value.report(f"`{key}` is not a known key here", meant)

"""The members of one ROS 2 message or of one half of a service.

In: fields, parameters, enumerators. Out: the lines of the text, each with its comment above it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import literals
from robocomp_dsl.generate import ros2_names as rules
from robocomp_dsl.generate.export import Spelling, report_renamed
from robocomp_dsl.generate.ros2_types import CLASH, Ros2Types
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import (
    Enum,
    Enumerator,
    ExceptionType,
    Field,
    Literal,
    Primitive,
    Type,
)


def comment(text: str) -> str:
    """`text` as comment lines."""
    return "".join(f"# {row}\n" if row else "#\n" for row in literals.lines(text))


class Members:
    """Collects the lines; names that would be the same get a number, which is reported."""

    def __init__(self, types: Ros2Types, package: str, report: Report) -> None:
        self._types = types
        self._package = package
        self._report = report
        self._members = Spelling(rules.member, rules.folded)
        self._lines: list[str] = []

    @property
    def text(self) -> str:
        """All lines."""
        return "".join(self._lines)

    def line(self, text: str, doc: str = "") -> None:
        """One line as it is."""
        self._lines.append(f"{comment(doc)}{text}\n")

    def reserve(self, *names: str) -> None:
        """Keep names that `line` has used from others."""
        for name in names:
            self._members.claim(name)

    def made(self, name: str, type_: Type | ExceptionType) -> None:
        """A member that IDSL has no name for, or whose name may change in silence."""
        self.line(f"{self._types.written(type_, self._package)} {self._members.claim(name)[0]}")

    def fields(self, all_: Iterable[Field]) -> None:
        """The fields of a struct or an exception, with their defaults."""
        for one in all_:
            default, said = _default(one)
            self._member(one, "\n".join(part for part in (one.doc, said) if part), default)

    def params(self, all_: Iterable[Param]) -> None:
        """Parameters."""
        for one in all_:
            self._member(one, "", "")

    def _member(self, one: Field | Param, doc: str, default: str) -> None:
        name, moved = self._members.claim(one.name)
        if moved:
            report_renamed(self._report, one.span, one.name, name, CLASH)
        written = self._types.written(one.type, self._package)
        unit = f"  # [{literals.printable(one.unit)}]" if one.unit else ""
        self.line(f"{written} {name}{default}{unit}", doc)

    def constants(self, all_: Iterable[Enumerator]) -> None:
        """The values of an enumeration."""
        scope = Spelling(rules.constant, rules.folded)
        for one in all_:
            name, moved = scope.claim(one.name)
            if moved:
                report_renamed(self._report, one.span, one.name, name, CLASH)
            self.line(f"int32 {name}={one.value}", one.doc)


def _default(one: Field) -> tuple[str, str]:
    """The default as a ROS 2 message has it; or in words where it cannot have it."""
    if one.default is None:
        return "", ""
    written = _written(one.default) if isinstance(one.type, Primitive) else None
    if written is not None:
        return f" {written}", ""
    shown = one.default if isinstance(one.type, Enum) else literals.quoted(str(one.default))
    return "", f"IDSL begins it with {shown}."


def _written(value: Literal) -> str | None:
    match value:
        case bool():
            return str(value).lower()
        case float():
            return repr(value) if math.isfinite(value) else None
        case str():
            # What tools make of escapes, and of a `#` in a text, differs.
            plain = (
                value.isprintable() and not set(value) & set("\"'\\#") and value == value.strip()
            )
            return f'"{value}"' if plain and value.isascii() else None
    return repr(value)

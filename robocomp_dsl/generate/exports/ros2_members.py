"""The members of one ROS 2 message or of one half of a service.

In: fields, parameters, enumerators. Out: the lines of the text, each with its comment above it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import literals
from robocomp_dsl.generate.export import report_renamed
from robocomp_dsl.generate.exports import ros2_names as rules
from robocomp_dsl.generate.exports.ros2_types import NAME_CLASH, Ros2Types
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
from robocomp_dsl.name_table import NameTable


def comment(text: str) -> str:
    """`text` as comment lines."""
    return "".join(f"# {row}\n" if row else "#\n" for row in literals.lines(text))


class MessageMembers:
    """Collects the lines of a message; duplicate names get a number, which is reported."""

    def __init__(self, types: Ros2Types, package: str, report: Report) -> None:
        self._types = types
        self._package = package
        self._report = report
        self._members = NameTable(rules.member_name, rules.fold_name)
        self._lines: list[str] = []

    @property
    def text(self) -> str:
        """All lines."""
        return "".join(self._lines)

    def line(self, text: str, doc: str = "") -> None:
        """Add a line unchanged."""
        self._lines.append(f"{comment(doc)}{text}\n")

    def reserve(self, *names: str) -> None:
        """Reserve names that `line` has used."""
        for name in names:
            self._members.claim(name)

    def generated_member(self, name: str, type_: Type | ExceptionType) -> None:
        """Add a member without an IDSL name; a changed name is not reported."""
        self.line(f"{self._types.member_type(type_, self._package)} {self._members.claim(name)[0]}")

    def fields(self, all_: Iterable[Field]) -> None:
        """Add the fields of a struct or an exception, with their defaults."""
        for field in all_:
            default, note = _default(field)
            self._member(field, "\n".join(part for part in (field.doc, note) if part), default)

    def params(self, all_: Iterable[Param]) -> None:
        """Add parameters."""
        for param in all_:
            self._member(param, "", "")

    def _member(self, member: Field | Param, doc: str, default: str) -> None:
        name, moved = self._members.claim(member.name)
        if moved:
            report_renamed(self._report, member.span, member.name, name, NAME_CLASH)
        type_ = self._types.member_type(member.type, self._package)
        unit = f"  # [{literals.printable(member.unit)}]" if member.unit else ""
        self.line(f"{type_} {name}{default}{unit}", doc)

    def constants(self, all_: Iterable[Enumerator]) -> None:
        """Add the values of an enumeration."""
        scope = NameTable(rules.constant_name, rules.fold_name)
        for enumerator in all_:
            name, moved = scope.claim(enumerator.name)
            if moved:
                report_renamed(self._report, enumerator.span, enumerator.name, name, NAME_CLASH)
            self.line(f"int32 {name}={enumerator.value}", enumerator.doc)


def _default(field: Field) -> tuple[str, str]:
    """The default in ROS 2 syntax, or a comment if ROS 2 cannot express it."""
    if field.default is None:
        return "", ""
    written = _format_default(field.default) if isinstance(field.type, Primitive) else None
    if written is not None:
        return f" {written}", ""
    shown = field.default if isinstance(field.type, Enum) else literals.quoted(str(field.default))
    return "", f"The default in IDSL is {shown}."


def _format_default(value: Literal) -> str | None:
    match value:
        case bool():
            return str(value).lower()
        case float():
            return repr(value) if math.isfinite(value) else None
        case str():
            # Tools differ in their treatment of escapes and of `#` in strings.
            plain = (
                value.isprintable() and not set(value) & set("\"'\\#") and value == value.strip()
            )
            return f'"{value}"' if plain and value.isascii() else None
    return repr(value)

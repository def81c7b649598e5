"""IDSL types as types of ROS 2 messages.

In: modules. Out: for each declaration its package and message name, and for each type how a member
is declared. A value has the same CDR bytes on both sides:

    bool, byte, short, int, long    bool, uint8, int16, int32, int64
    float, double, string           float32, float64, string
    struct, exception               a message of its members
    enum                            a message with constants and one member `int32 value`
    sequence<T>                     T[]; where ROS allows no array, a message with one member `data`
    dictionary<K, V>                an array of `<name>Entry` messages with `key` and `value`
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import ros2_names as rules
from robocomp_dsl.generate.export import Spelling, report_renamed
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.model.types import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    LONG,
    SHORT,
    STRING,
    Declaration,
    Dictionary,
    ExceptionType,
    Primitive,
    Type,
)
from robocomp_dsl.model.types import Sequence as SequenceType

PRIMITIVES = {
    BOOL: "bool",
    BYTE: "uint8",
    SHORT: "int16",
    INT: "int32",
    LONG: "int64",
    FLOAT: "float32",
    DOUBLE: "float64",
    STRING: "string",
}
CLASH = "in ROS 2 another one would have the same name"


class Ros2Types:
    """The packages and messages of all modules of an export."""

    def __init__(self, modules: Sequence[Module], report: Report) -> None:
        self._packages: dict[str, str] = {}
        self._messages: dict[Declaration, str] = {}
        self._entries: dict[Dictionary, str] = {}
        self._operations: dict[Operation, str] = {}
        packages = Spelling(rules.snake, rules.folded)
        scopes: dict[str, Spelling] = {}
        for one in modules:
            if one.name not in self._packages:
                self._packages[one.name], moved = packages.claim(one.name)
                scopes[one.name] = Spelling(rules.camel, rules.folded)
                if moved:
                    report_renamed(report, one.span, one.name, self._packages[one.name], CLASH)
            self._name(one, scopes[one.name], report)

    def _name(self, module: Module, scope: Spelling, report: Report) -> None:
        """Types first, so that what is only made here gives way to them."""
        data = [d for d in module.declarations if not isinstance(d, Interface)]
        for one in data:
            self._messages[one], moved = scope.claim(one.name)
            if moved:
                report_renamed(report, one.span, one.name, self._messages[one], CLASH)
        for one in data:
            if isinstance(one, Dictionary):
                self._entries[one], _ = scope.claim(f"{self._messages[one]}Entry")
        for interface in module.interfaces:
            for each in interface.operations:
                name = f"{rules.camel(interface.name)}_{each.name[:1].upper()}{each.name[1:]}"
                self._operations[each], moved = scope.claim(name)
                if moved:
                    report_renamed(report, each.span, each.name, self._operations[each], CLASH)

    def package(self, module: str) -> str:
        """The package of a module."""
        return self._packages[module]

    def message(self, one: Declaration) -> str:
        """The message that a type becomes."""
        return self._messages[one]

    def entry(self, one: Dictionary) -> str:
        """The message of one pair of a dictionary."""
        return self._entries[one]

    def operation(self, one: Operation) -> str:
        """The service of an operation; and its message, where it needs one to be published."""
        return self._operations[one]

    def written(self, one: Type | ExceptionType, package: str) -> str:
        """`one` as the type of a member in a message of `package`."""
        match one:
            case SequenceType():
                return f"{self.element(one.element, package)}[]"
            case Dictionary():
                return f"{self._reached(one, self._entries[one], package)}[]"
        return self.element(one, package)

    def element(self, one: Type | ExceptionType, package: str) -> str:
        """`one` without an array: a sequence or dictionary is wrapped in its message."""
        if isinstance(one, Primitive):
            return PRIMITIVES[one]
        return self._reached(one, self._messages[one], package)

    def _reached(self, one: Declaration, message: str, package: str) -> str:
        home = self._packages[one.module]
        return message if home == package else f"{home}/{message}"

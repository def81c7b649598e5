"""IDSL types as types of ROS 2 messages.

In: modules. Out: the package and message name of each declaration, and the member type of each
type. A value has the same CDR bytes on both sides:

    bool, byte, short, int, long    bool, uint8, int16, int32, int64
    unsigned short, int, long       uint16, uint32, uint64
    float, double, string           float32, float64, string
    struct, exception               a message of its members
    enum                            a message with constants and one member `int32 value`
    sequence<T>                     T[]; a nested array is a message with one member `data`
    sequence<T, 10>                 T[<=10]
    array of 36                     T[36]
    dictionary<K, V>                an array of `<name>Entry` messages with `key` and `value`
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import report_renamed
from robocomp_dsl.generate.exports import ros2_names as rules
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
    UINT16,
    UINT32,
    UINT64,
    Declaration,
    Dictionary,
    ExceptionType,
    Primitive,
    Type,
)
from robocomp_dsl.model.types import Sequence as SequenceType
from robocomp_dsl.name_table import NameTable

PRIMITIVES = {
    BOOL: "bool",
    BYTE: "uint8",
    SHORT: "int16",
    INT: "int32",
    LONG: "int64",
    FLOAT: "float32",
    DOUBLE: "float64",
    STRING: "string",
    UINT16: "uint16",
    UINT32: "uint32",
    UINT64: "uint64",
}
NAME_CLASH = "another name would be the same in ROS 2"


class Ros2Types:
    """The packages and messages of all modules of an export."""

    def __init__(self, modules: Sequence[Module], report: Report) -> None:
        self._packages: dict[str, str] = {}
        self._messages: dict[Declaration, str] = {}
        self._entries: dict[Dictionary, str] = {}
        self._operations: dict[Operation, str] = {}
        packages = NameTable(rules.package_name, rules.fold_name)
        scopes: dict[str, NameTable] = {}
        for module in modules:
            if module.is_ros:
                self._packages[module.name] = module.name
                self._messages |= {d: d.name for d in module.declarations}
                continue
            if module.name not in self._packages:
                self._packages[module.name], moved = packages.claim(module.name)
                scopes[module.name] = NameTable(rules.message_name, rules.fold_name)
                if moved:
                    report_renamed(
                        report, module.span, module.name, self._packages[module.name], NAME_CLASH
                    )
            self._name_declarations(module, scopes[module.name], report)

    def _name_declarations(self, module: Module, scope: NameTable, report: Report) -> None:
        """Claim names of types first, so that generated names get the numbers."""
        data = [d for d in module.declarations if not isinstance(d, Interface)]
        for declaration in data:
            self._messages[declaration], moved = scope.claim(declaration.name)
            if moved:
                report_renamed(
                    report,
                    declaration.span,
                    declaration.name,
                    self._messages[declaration],
                    NAME_CLASH,
                )
        for declaration in data:
            if isinstance(declaration, Dictionary):
                self._entries[declaration], _ = scope.claim(f"{self._messages[declaration]}Entry")
        for interface in module.interfaces:
            for each in interface.operations:
                name = (
                    f"{rules.message_name(interface.name)}_{each.name[:1].upper()}{each.name[1:]}"
                )
                self._operations[each], moved = scope.claim(name)
                if moved:
                    report_renamed(report, each.span, each.name, self._operations[each], NAME_CLASH)

    def package(self, module: str) -> str:
        """The package of a module."""
        return self._packages[module]

    def message(self, declaration: Declaration) -> str:
        """The message of a type."""
        return self._messages[declaration]

    def entry(self, dictionary: Dictionary) -> str:
        """The message of one pair of a dictionary."""
        return self._entries[dictionary]

    def operation(self, operation: Operation) -> str:
        """The name of an operation's service, and of its message if it has one."""
        return self._operations[operation]

    def member_type(self, type_: Type | ExceptionType, package: str) -> str:
        """`one` as the type of a member in a message of `package`."""
        match type_:
            case SequenceType():
                limit = type_.size or (f"<={type_.bound}" if type_.bound else "")
                return f"{self.element_type(type_.element, package)}[{limit}]"
            case Dictionary():
                return f"{self._qualify(type_, self._entries[type_], package)}[]"
        return self.element_type(type_, package)

    def element_type(self, type_: Type | ExceptionType, package: str) -> str:
        """`one` without an array: a sequence or dictionary is wrapped in its message."""
        if isinstance(type_, Primitive):
            return PRIMITIVES[type_]
        return self._qualify(type_, self._messages[type_], package)

    def _qualify(self, declaration: Declaration, message: str, package: str) -> str:
        home = self._packages[declaration.module]
        return message if home == package else f"{home}/{message}"

"""The module `<Bridge>Types` with the types and interfaces that a bridge declares itself.

In: inline types and lists of ports. Out: declarations with unique names, and the module of those
that ports or functions use.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern
from robocomp_dsl.model.types import (
    Declaration,
    Dictionary,
    Field,
    Primitive,
    Sequence,
    Struct,
    Type,
)
from robocomp_dsl.source import Span


@lru_cache(maxsize=10_000)
def camel_case(name: str) -> str:
    """`left_wheel` as `LeftWheel`."""
    parts = (part for part in name.split("_") if part)
    return "".join(part[0].upper() + part[1:] for part in parts) or "Item"


class TypesModule:
    """Collects the declarations of a bridge."""

    def __init__(self, bridge: str, path: Path, span: Span) -> None:
        self.name = f"{camel_case(bridge)}Types"
        self._path = path
        self._span = span
        self._names: set[str] = set()
        self._sequences: dict[tuple[object, int], Sequence] = {}
        self._structs: dict[object, Struct] = {}
        self._interfaces: list[Interface] = []
        self._function_types: list[Type] = []

    def sequence(self, element: Type, size: int, span: Span) -> Sequence:
        """A list of `element`; `size` 0: of any length. Equal lists are one declaration."""
        key = (_identity(element), size)
        if key not in self._sequences:
            stem = camel_case(re.sub(r"\W", "", element.name))
            name = self._unique(f"{stem}{size or ''}List")
            self._sequences[key] = Sequence(self.name, name, span, "", element, size)
        return self._sequences[key]

    def struct(self, name: str, fields: tuple[Field, ...], span: Span) -> Struct:
        """A struct called `name`, or `name` with a number. Equal structs are one declaration."""
        key = tuple((field.name, _identity(field.type), field.unit) for field in fields)
        if key not in self._structs:
            self._structs[key] = Struct(self.name, self._unique(name), span, "", fields)
        return self._structs[key]

    def keep(self, type_: Type) -> None:
        """Declare `type_` in the module: a function uses it."""
        self._function_types.append(type_)

    def interface(
        self, name: str, operation: str, inputs: tuple[Param, ...], span: Span, result: Type | None
    ) -> Interface:
        """An interface with one operation: a topic, or a service if it has a result."""
        pattern = Pattern.QUERY if result else Pattern.PUBLISH
        member = Operation(operation, span, pattern, inputs, (), result, (), False, True)
        interface = Interface(self.name, self._unique(name), span, "", (member,))
        self._interfaces.append(interface)
        return interface

    def module(self, imported: Iterable[Module], doc: str) -> Module | None:
        """The module, importing those of `imported` that it uses; None if it is empty."""
        used: dict[int, Declaration] = {}
        for type_ in self._function_types:
            _collect(type_, used)
        for interface in self._interfaces:
            for operation in interface.operations:
                for param in operation.inputs:
                    _collect(param.type, used)
                if operation.result:
                    _collect(operation.result, used)
        own = [d for d in used.values() if d.module == self.name]
        if not own and not self._interfaces:
            return None
        every = {id(m): m for direct in imported for m in direct.closure()}.values()
        imports = tuple(m for m in every if any(id(d) in used for d in m.declarations))
        declarations = (*own, *self._interfaces)
        return Module(self.name, self._path, self._span, doc, imports, declarations)

    def _unique(self, name: str) -> str:
        number, free = 1, name
        while free.lower() in self._names:
            number += 1
            free = f"{name}{number}"
        self._names.add(free.lower())
        return free


def _identity(type_: Type) -> object:
    """What equal types have in common."""
    return type_ if isinstance(type_, Primitive) else id(type_)


def _collect(type_: Type, used: dict[int, Declaration]) -> None:
    """Add the declarations of `type_` to `used`, those it consists of first."""
    if isinstance(type_, Primitive) or id(type_) in used:
        return
    match type_:
        case Struct():
            for field in type_.fields:
                _collect(field.type, used)
        case Sequence():
            _collect(type_.element, used)
        case Dictionary():
            _collect(type_.key, used)
            _collect(type_.value, used)
    used[id(type_)] = type_

"""The user's class and its bases, wherever in the folder they are made.

In: a module of the user. Out: the classes in the order in which Python looks into them, each with
the module that it stands in, and the names of bases that are not to be found here. Modules beside
the file are read, nothing is imported.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from robocomp_dsl.record import Record

if TYPE_CHECKING:
    from robocomp_dsl.generate.upkeep.user_module import UserModule

CLASS = "SpecificWorker"
BASE = "GenericWorker"
_EMPTY = {BASE, "object", "Generic", "Protocol", "ABC"}
"""Bases with no method that anybody calls; what `GenericWorker` has raises."""

_BLOCKS = (ast.If, ast.Try, ast.TryStar, ast.With, ast.For, ast.While, ast.Match)


class Hierarchy(Record):
    """The classes, the user's first; and bases from elsewhere."""

    classes: list[tuple[UserModule, ast.ClassDef]]
    unknown: list[str]


def hierarchy(user: UserModule) -> Hierarchy:
    """The class with its bases, and with theirs."""
    found = Hierarchy([], [])
    _add(ast.Name(CLASS, ast.Load()), user, found)
    return found


def statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements of a module or a class, and those within `if`, `try` and the like."""
    for one in body:
        yield one
        if not isinstance(one, _BLOCKS):
            continue
        for part in ast.iter_child_nodes(one):
            if isinstance(part, ast.stmt):
                yield from statements([part])
            elif isinstance(part, ast.ExceptHandler | ast.match_case):
                yield from statements(part.body)


def _add(base: ast.expr, module: UserModule, found: Hierarchy) -> None:
    if isinstance(base, ast.Subscript):  # Generic[T]
        base = base.value
    name = base.attr if isinstance(base, ast.Attribute) else getattr(base, "id", "")
    if name in _EMPTY:
        return
    where = _found(base, module, set())
    if where is None:
        found.unknown.append(name or ast.unparse(base))
    elif not any(one is where[1] for _, one in found.classes):
        found.classes.append(where)
        for inner in where[1].bases:
            _add(inner, where[0], found)


_Place: TypeAlias = "tuple[UserModule, ast.ClassDef]"
_Seen: TypeAlias = set[tuple[Path, str]]


def _found(base: ast.expr, module: UserModule, seen: _Seen) -> _Place | None:
    """The class that an expression names, and the module it stands in."""
    match base:
        case ast.Name(id=name):
            ways = (_by_name(name, one, module, seen) for one in _last_first(module))
            return next(filter(None, ways), None)
        case ast.Attribute(value=ast.Name(id=owner), attr=name):
            for one in _last_first(module):
                for alias in one.names if isinstance(one, ast.Import) else ():
                    if (alias.asname or alias.name) == owner:
                        return _there(name, module.beside(alias.name), seen)
    return None


def _by_name(name: str, one: ast.stmt, module: UserModule, seen: _Seen) -> _Place | None:
    """The class, if this statement gives it that name."""
    match one:
        case ast.ClassDef() if one.name == name:
            return module, one
        case ast.Assign(targets=[ast.Name(id=target)], value=value) if target == name:
            return _there(ast.unparse(value), module, seen, value)
        case ast.ImportFrom(module=str(origin)):
            for alias in one.names:
                if (alias.asname or alias.name) == name:
                    return _there(alias.name, module.beside(origin), seen)
    return None


def _last_first(module: UserModule) -> list[ast.stmt]:
    """Its statements; the last one that makes a name counts."""
    return list(statements(module.tree.body))[::-1]


def _there(
    name: str, module: UserModule | None, seen: _Seen, value: ast.expr | None = None
) -> _Place | None:
    """Look on in another module, or for another name; not twice in the same place."""
    if module is None or (key := (module.source.path, name)) in seen:
        return None
    seen.add(key)
    return _found(value or ast.Name(name, ast.Load()), module, seen)

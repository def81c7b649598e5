"""The user's class and its bases, in any module of the folder.

In: a module of the user. Out: the classes in Python's lookup order, each with its module, and the
names of bases from other folders. Modules in the same folder are parsed, nothing is imported.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.generate.regeneration.python_module import PythonModule
from robocomp_dsl.record import Record

CLASS = "SpecificWorker"
BASE = "GenericWorker"
_EMPTY = {BASE, "object", "Generic", "Protocol", "ABC"}
"""Bases without methods that are called; the methods of `GenericWorker` only raise."""

_BLOCKS = (ast.If, ast.Try, ast.TryStar, ast.With, ast.For, ast.While, ast.Match)


class Hierarchy(Record):
    """The classes, the user's first; and bases from other folders."""

    classes: list[tuple[PythonModule, ast.ClassDef]]
    unknown: list[str]


def hierarchy(user: PythonModule) -> Hierarchy:
    """The class with all its direct and indirect bases."""
    found = Hierarchy([], [])
    _add(ast.Name(CLASS, ast.Load()), user, found)
    return found


def statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements of a module or a class, including those within `if`, `try` etc."""
    for statement in body:
        yield statement
        if not isinstance(statement, _BLOCKS):
            continue
        for part in ast.iter_child_nodes(statement):
            if isinstance(part, ast.stmt):
                yield from statements([part])
            elif isinstance(part, ast.ExceptHandler | ast.match_case):
                yield from statements(part.body)


def _add(base: ast.expr, module: PythonModule, found: Hierarchy) -> None:
    if isinstance(base, ast.Subscript):  # Generic[T]
        base = base.value
    name = base.attr if isinstance(base, ast.Attribute) else getattr(base, "id", "")
    if name in _EMPTY:
        return
    where = _found(base, module, set())
    if where is None:
        found.unknown.append(name or ast.unparse(base))
    elif not any(class_ is where[1] for _, class_ in found.classes):
        found.classes.append(where)
        for inner in where[1].bases:
            _add(inner, where[0], found)


_Place: TypeAlias = "tuple[PythonModule, ast.ClassDef]"
_Seen: TypeAlias = set[tuple[Path, str]]


def _found(base: ast.expr, module: PythonModule, seen: _Seen) -> _Place | None:
    """The class that an expression names, and its module."""
    match base:
        case ast.Name(id=name):
            candidates = (
                _by_name(name, statement, module, seen) for statement in _last_first(module)
            )
            return next(filter(None, candidates), None)
        case ast.Attribute(value=ast.Name(id=owner), attr=name):
            for statement in _last_first(module):
                for alias in statement.names if isinstance(statement, ast.Import) else ():
                    if (alias.asname or alias.name) == owner:
                        return _there(name, module.beside(alias.name), seen)
    return None


def _by_name(name: str, statement: ast.stmt, module: PythonModule, seen: _Seen) -> _Place | None:
    """The class, if this statement defines it under that name."""
    match statement:
        case ast.ClassDef() if statement.name == name:
            return module, statement
        case ast.Assign(targets=[ast.Name(id=target)], value=value) if target == name:
            return _there(ast.unparse(value), module, seen, value)
        case ast.ImportFrom(module=str(origin)):
            for alias in statement.names:
                if (alias.asname or alias.name) == name:
                    return _there(alias.name, module.beside(origin), seen)
    return None


def _last_first(module: PythonModule) -> list[ast.stmt]:
    """Its statements; the last definition of a name is used."""
    return list(statements(module.tree.body))[::-1]


def _there(
    name: str, module: PythonModule | None, seen: _Seen, value: ast.expr | None = None
) -> _Place | None:
    """Continue in another module, or with another name; each place is searched once."""
    if module is None or (key := (module.source.path, name)) in seen:
        return None
    seen.add(key)
    return _found(value or ast.Name(name, ast.Load()), module, seen)

"""Resolves local names of a method from the source text.

In: a statement of a class. Out: for each name the expressions that it is bound to; a name with any
other binding has none.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from typing import TypeAlias

from robocomp_dsl.record import ValueRecord


class Binding(ValueRecord):
    """The value of an expression or, with `each`, one element of it after the other."""

    value: ast.expr
    each: bool


Names: TypeAlias = dict[str, list[Binding]]


def local_names(method: ast.AST) -> Names:
    """`m = self.params.motors[0]`, `for m in self.params.motors`, and comprehensions."""
    found: Names = {}
    for node in ast.walk(method):
        for name, bound in _bound(node):
            found.setdefault(name, []).append(bound)
    all_ = Counter(_stored(method))
    return {name: ways for name, ways in found.items() if all_[name] == len(ways)}


def _bound(node: ast.AST) -> Iterator[tuple[str, Binding]]:
    match node:
        case ast.Assign(targets=[ast.Name(id=name)], value=value):
            yield name, Binding(value, each=False)
        case ast.NamedExpr(target=ast.Name(id=name), value=value):
            yield name, Binding(value, each=False)
        case ast.For(target=target, iter=value) | ast.comprehension(target=target, iter=value):
            yield from _of_loop(target, value)


def _of_loop(target: ast.expr, value: ast.expr) -> Iterator[tuple[str, Binding]]:
    """`for m in motors`, `for i, m in enumerate(motors)`, `for m, x in zip(motors, xs)`."""
    match target, value:
        case ast.Tuple(elts=[_, inner]), ast.Call(func=ast.Name(id="enumerate"), args=[of, *_]):
            yield from _of_loop(inner, of)
        case ast.Tuple(elts=parts), ast.Call(func=ast.Name(id="zip"), args=iterables):
            for part, of in zip(parts, iterables, strict=False):
                yield from _of_loop(part, of)
        case ast.Name(), ast.Call(func=ast.Name(id="reversed" | "sorted"), args=[of, *_]):
            yield from _of_loop(target, of)
        case ast.Name(id=name), _:
            yield name, Binding(value, each=True)


def _stored(method: ast.AST) -> Iterator[str]:
    """Every binding of every name."""
    for node in ast.walk(method):
        match node:
            case ast.Name(id=name, ctx=ast.Store() | ast.Del()) | ast.arg(arg=name):
                yield name
            case ast.Global(names=names) | ast.Nonlocal(names=names):
                yield from names
            case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
                yield name
            case ast.alias(name=name, asname=other):
                yield other or name

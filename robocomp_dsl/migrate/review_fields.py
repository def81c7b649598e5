"""Review the fields of structs that old code uses: the found IDSL file may lack some.

In: the modules that the worker imports, the new component. Out: findings about fields, also those
in constructors, that a struct does not have. Types are known for values from constructors, proxies
and parameters of handlers; a name with values of several types is left out.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import names as python_names
from robocomp_dsl.generate.python.component_names import modules_of, names_of
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate.imports import span_of
from robocomp_dsl.migrate.worker_codes import MISSING_NAME
from robocomp_dsl.model import types as model
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Operation

_Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
_Known: TypeAlias = Mapping[str, Any]
"""Types of the model by the name of a variable; None: values of several types."""


def review_fields(modules: Sequence[UserModule], component: Component, report: Report) -> None:
    """Report fields that structs of the component's interfaces do not have."""
    types = _Types(component)
    for module in modules:
        types.own_names = frozenset(_bound_names(module.tree))
        for function in ast.walk(module.tree):
            if isinstance(function, _Function):
                known = types.variables_of(function)
                for node, struct, field in types.missing(function, known):
                    message = f"`{struct}` has no field `{field}` in the IDSL file that was found"
                    report.add(MISSING_NAME, span_of(module, node), message)


class _Types:
    """What is known about the types of expressions in the code of one component."""

    def __init__(self, component: Component) -> None:
        self.own_names: frozenset[str] = frozenset()  # of the module that is reviewed
        self._structs: dict[str, dict[str, model.Struct]] = {}
        for module in modules_of(component):
            self._structs[module.name] = {
                python_names.identifier(d.name): d
                for d in module.declarations
                if isinstance(d, model.Struct)
            }
        called = names_of(component)
        self._handlers: dict[str, Operation] = {}
        for (_, operation), name in called.handlers.items():
            self._handlers[operation.name] = self._handlers[name] = operation
        self._proxies = {name: port for port, name in called.proxies.items()}

    def variables_of(self, function: _Function) -> dict[str, Any]:
        """The types of the variables of a function whose values all have one known type."""
        known: dict[str, Any] = {}
        operation = self._handlers.get(function.name)
        if operation is not None:
            names = [argument.arg for argument in function.args.args[1:]]
            known |= {name: p.type for name, p in zip(names, operation.inputs, strict=False)}
        parameters = dict(known)
        for _ in range(3):  # a variable may depend on others
            found = dict(parameters)
            for name, value in _assignments(function):
                kind = self.type_of(value, known) if value is not None else None
                found[name] = kind if found.get(name, kind) == kind else None
            known = found
        return {name: kind for name, kind in known.items() if kind is not None}

    def type_of(self, node: ast.expr, known: _Known) -> Any:  # noqa: PLR0911 - one per form
        """The type of an expression; None if it is not known."""
        match node:
            case ast.Name(id=name):
                return known.get(name)
            case ast.Attribute(value=value, attr=name):
                struct = self.type_of(value, known)
                fields = _fields(struct) if isinstance(struct, model.Struct) else {}
                return fields.get(name)
            case ast.Subscript(value=value, slice=ast.Slice()):
                return self.type_of(value, known)
            case ast.Subscript(value=value):
                return _element(self.type_of(value, known))
            case ast.Starred(value=value):  # an item of what a loop iterates over
                iterated = self.type_of(value, known)
                return iterated.element if isinstance(iterated, model.Sequence) else None
            case ast.Call(func=ast.Attribute(value=ast.Attribute(attr=proxy), attr=called)) if (
                proxy in self._proxies
            ):
                operations = {o.name: o for o in self._proxies[proxy].operations}
                operation = operations.get(called)
                return operation.result if operation and not operation.outputs else None
            case ast.Call():
                return self._constructed(node)
        return None

    def missing(self, function: _Function, known: _Known) -> Iterator[tuple[ast.expr, str, str]]:
        """The expressions that name a field that a struct does not have, struct, and field."""
        for node in ast.walk(function):
            if isinstance(node, ast.Call) and (struct := self._constructed(node)) is not None:
                for keyword in node.keywords:
                    if keyword.arg is not None and keyword.arg not in _fields(struct):
                        yield keyword.value, struct.name, keyword.arg
            elif isinstance(node, ast.Attribute) and not node.attr.startswith("__"):
                struct = self.type_of(node.value, known)
                if isinstance(struct, model.Struct) and node.attr not in _fields(struct):
                    yield node, struct.name, node.attr

    def _constructed(self, call: ast.Call) -> model.Struct | None:
        match call.func:
            case ast.Attribute(value=ast.Name(id=owner) | ast.Attribute(attr=owner), attr=name):
                return self._structs.get(owner, {}).get(name)
            case ast.Name(id=name) if name not in self.own_names:
                found = [s[name] for s in self._structs.values() if name in s]
                return found[0] if len(found) == 1 else None
        return None


def _bound_names(tree: ast.Module) -> Iterator[str]:
    """The names that a module defines or imports by name."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef | _Function):
            yield node.name
        elif isinstance(node, ast.Import | ast.ImportFrom) and not _is_of_interface(node):
            yield from (alias.asname or alias.name for alias in node.names)


def _is_of_interface(node: ast.Import | ast.ImportFrom) -> bool:
    return isinstance(node, ast.ImportFrom) and (node.module or "").startswith("RoboComp")


def _assignments(function: _Function) -> Iterator[tuple[str, ast.expr | None]]:
    """The names that a function assigns, with the value; None: a value that is not followed."""
    for node in ast.walk(function):
        targets: Sequence[ast.expr] = ()
        value: ast.expr | None = None
        match node:
            case ast.Assign():
                targets, value = node.targets, node.value
            case ast.AnnAssign(value=ast.expr()):
                targets, value = [node.target], node.value
            case ast.For(target=ast.Name() as target, iter=iterable):
                targets, value = [target], ast.Starred(iterable, ast.Load())
            case ast.For() | ast.AugAssign() | ast.NamedExpr() | ast.comprehension():
                targets = [node.target]
            case ast.withitem(optional_vars=ast.expr() as target):
                targets = [target]
        if len(targets) == 1 and isinstance(targets[0], ast.Name):
            yield targets[0].id, value
        else:
            yield from (
                (name.id, None)
                for target in targets
                for name in ast.walk(target)
                if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
            )


def _fields(struct: model.Struct) -> dict[str, model.Type]:
    """The fields of a struct, with the names that Ice and this package give them."""
    fields = {}
    for field in struct.fields:
        for name in (field.name, python_names.identifier(field.name), f"_{field.name}"):
            fields[name] = field.type
    return fields


def _element(kind: Any) -> Any:
    """The type of the values of a sequence, or of the values of a dictionary by key."""
    if isinstance(kind, model.Sequence):
        return kind.element
    return kind.value if isinstance(kind, model.Dictionary) else None

"""An unimplemented driver: the methods of a Protocol, each raising `DriverMethodMissing`.

In: a module of `robocomp_dsl.hardware`, the name of a Protocol in it, and values of its properties.
Out: the source of the methods, and the imports that they need. The module is read, not run.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

import robocomp_dsl
from robocomp_dsl.generate.python.layout import BODY, INNER, WIDTH

PACKAGE = "robocomp_dsl.hardware"
_HARDWARE = Path(robocomp_dsl.__file__).parent / "hardware"


@dataclass(frozen=True, slots=True)
class Skeleton:
    """Lines of `import`, sorted, and lines of the body of a class."""

    imports: tuple[str, ...]
    lines: tuple[str, ...]


def skeleton(module: str, protocol: str, known: Mapping[str, object]) -> Skeleton:
    """A class that implements `protocol`; properties in `known` already return these values.

    `module` contains the protocol, relative to `robocomp_dsl.hardware`, as `devices.laser`.
    """
    path = _HARDWARE.joinpath(*module.split(".")).with_suffix(".py")
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = next(n for n in tree.body if isinstance(n, ast.ClassDef) and n.name == protocol)
    methods = [node for node in found.body if isinstance(node, ast.FunctionDef)]
    lines: list[str] = []
    needed: set[tuple[str, str]] = {(f"{PACKAGE}.devices.errors", "DriverMethodMissing")}
    homes = _homes(tree, f"{PACKAGE}.{module}")
    for method in methods:
        value = known.get(method.name)
        lines += ["", *_method(method, value)]
        needed |= {(homes[name], name) for name in _mentioned(method) if name in homes}
        needed |= set(_types(value))
    return Skeleton(tuple(_imports(needed, "\n".join(lines))), tuple(lines))


def _method(method: ast.FunctionDef, value: object) -> Iterator[str]:
    """Decorators, head and docstring, and a body that returns the value or raises."""
    for decorator in method.decorator_list:
        yield f"{INNER}@{ast.unparse(decorator)}"
    returns = ast.unparse(method.returns) if method.returns else "None"
    yield f"{INNER}def {method.name}({ast.unparse(method.args)}) -> {returns}:"
    yield from (f"{BODY}{line}".rstrip() for line in _docstring(method))
    if value is None:
        yield f'{BODY}raise DriverMethodMissing("{method.name}")'
    else:
        written = _written(value, BODY)
        yield f"{BODY}return {written}"


def _docstring(method: ast.FunctionDef) -> list[str]:
    first, *rest = (ast.get_docstring(method) or "").splitlines()
    return [f'"""{first}"""'] if not rest else [f'"""{first}', *rest, '"""']


def _homes(tree: ast.Module, module: str) -> dict[str, str]:
    """The module that defines each imported name of this module."""
    homes: dict[str, str] = {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module:
            homes |= {alias.name: node.module for alias in node.names}
        elif isinstance(node, ast.ClassDef):
            homes[node.name] = module
    return homes


def _mentioned(method: ast.FunctionDef) -> set[str]:
    arguments = [argument.annotation for argument in method.args.args if argument.annotation]
    notes = [*arguments, *([method.returns] if method.returns else [])]
    return {n.id for note in notes for n in ast.walk(note) if isinstance(n, ast.Name)}


def _written(value: Any, indent: str) -> str:
    """A value as source, formatted with one entry per line."""
    if is_dataclass(value) and not isinstance(value, type):
        arguments = [
            f"{field.name}={_written(getattr(value, field.name), indent + '    ')}"
            for field in fields(value)
            if not _usual(field, getattr(value, field.name))
        ]
        return _called(type(value).__name__, arguments, indent)
    if isinstance(value, tuple):
        return _called("", [_written(element, f"{indent}    ") for element in value], indent)
    if isinstance(value, float) and not math.isfinite(value):
        return ("-" if value < 0 else "") + "math.inf"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _called(name: str, arguments: list[str], indent: str) -> str:
    if not arguments:
        return f"{name}()"
    inside = "".join(f"{indent}    {argument},\n" for argument in arguments)
    return f"{name}(\n{inside}{indent})"


def _usual(field: Any, value: Any) -> bool:
    """Whether a field can be omitted: it has its default, or is an array, which is computed."""
    if hasattr(value, "shape"):
        return True
    return field.default is not MISSING and bool(field.default == value)


def _types(value: Any) -> Iterator[tuple[str, str]]:
    if is_dataclass(value) and not isinstance(value, type):
        yield type(value).__module__, type(value).__name__
        for field in fields(value):
            if not _usual(field, getattr(value, field.name)):
                yield from _types(getattr(value, field.name))
    elif isinstance(value, tuple):
        for element in value:
            yield from _types(element)


def _imports(needed: set[tuple[str, str]], body: str) -> Iterator[str]:
    """One line per module, or broken as the formatter does."""
    if "math." in body:
        yield "import math"
        yield ""
    for module in sorted({module for module, _ in needed}):
        names = sorted((name for of, name in needed if of == module), key=_isorted)
        line = f"from {module} import {', '.join(names)}"
        if len(line) > WIDTH:
            yield f"from {module} import ("
            yield from (f"    {name}," for name in names)
            yield ")"
        else:
            yield line


def _isorted(name: str) -> tuple[bool, str]:
    return (not name.isupper(), name)

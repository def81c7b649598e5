"""Import statements of old modules: which may fail, and what relative ones name.

In: syntax trees. Out: the nodes of optional imports, absolute names of relative imports.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

_IMPORT_ERRORS = {"ImportError", "ModuleNotFoundError", "Exception", "BaseException", "Error"}


def optional_nodes(tree: ast.Module) -> Iterator[ast.AST]:
    """The nodes in `try` blocks that catch the error of an import."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Try):
            continue
        caught = {_caught_name(handler.type) for handler in node.handlers}
        if caught & _IMPORT_ERRORS or "" in caught:
            for statement in node.body:
                yield from ast.walk(statement)


def _caught_name(expression: ast.expr | None) -> str:
    """The last name of a caught type; empty for a bare `except`; the first of several."""
    if isinstance(expression, ast.Tuple):
        return _caught_name(expression.elts[0]) if expression.elts else ""
    return ast.unparse(expression).rpartition(".")[2] if expression else ""


def relative_imports(tree: ast.Module) -> Iterator[ast.ImportFrom]:
    """The relative imports that must succeed."""
    optional = set(optional_nodes(tree))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level and node not in optional:
            yield node


def absolute_name(node: ast.ImportFrom, package: Sequence[str]) -> str | None:
    """The module that a relative import names, as a dotted name from the old worker's folder.

    `package` are the folders of the importing module. None: it is outside of that folder.
    """
    above = node.level - 1
    if above > len(package):
        return None
    parts = list(package[: len(package) - above])
    return ".".join([*parts, *([node.module] if node.module else [])])

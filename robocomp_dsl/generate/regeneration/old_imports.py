"""Renames the package `generated` in a Python module of the user.

In: the module and the modules of the package. Out: its text with the new name in import statements,
in the names that these bind, and in file paths; nothing else changes. Uncertain places are listed.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span

OLD = "generated"
_FROM = re.compile(rf"from[\s\\]+\.*[\s\\]*({OLD})\b")
_DATA = re.compile(r"scene\.json|.*\.xml")
"""Data files of the package."""
_MENTION = re.compile(rf"(^|[/\\'\"])({OLD})([./\\]|$)")


class Migrated(ValueRecord):
    """The text with the new name; places and messages where the old name remains."""

    text: str
    left: tuple[tuple[Span, str], ...]


def migrated(user: UserModule, package: str, modules: set[str]) -> Migrated:
    """`user` for the new package; `modules` are the generated modules of the old one."""
    nodes = list(ast.walk(user.tree))
    foreign = [node for node in nodes if _is_foreign(node, modules)]
    left = [
        (
            _span(user, statement),
            f"this import from `{OLD}` names a module that rcgen did not write",
        )
        for statement in foreign
    ]
    if _is_bound_otherwise(nodes, foreign):
        ambiguous = [node for node in nodes if _binds(node) and node not in foreign]
        left += [
            (_span(user, statement), f"`{OLD}` is not only a package in this file")
            for statement in ambiguous
        ]
        foreign += ambiguous
    places = {at for node in nodes if node not in foreign for at in _import_places(user, node)}
    if any(_binds(node) and node not in foreign for node in nodes):
        places |= {
            user.offset(node.lineno, node.col_offset)
            for node in nodes
            if isinstance(node, ast.Name) and node.id == OLD
        }
    paths = dict(_path_places(user, nodes))
    places |= set(paths.values())
    left += [
        (_span(user, node), f"this text names the folder `{OLD}`")
        for node in nodes
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and node not in paths
        and _MENTION.search(node.value)
        and "\n" not in node.value
    ]
    text = user.source.text
    for at in sorted(places, reverse=True):
        text = text[:at] + package + text[at + len(OLD) :]
    return Migrated(text, tuple(left))


def _is_foreign(node: ast.AST, modules: set[str]) -> bool:
    """Whether a statement imports something from the old package that was not generated."""
    known = modules | {"*"}
    if isinstance(node, ast.ImportFrom):
        if node.module == OLD:
            return any(name.name not in known for name in node.names)
        first, _, rest = (node.module or "").partition(".")
        return first == OLD and rest not in known
    if isinstance(node, ast.Import):
        parts = (name.name.partition(".") for name in node.names)
        return any(first == OLD and rest and rest not in known for first, _, rest in parts)
    return False


def _import_places(user: UserModule, node: ast.AST) -> Iterator[int]:
    """Where an import statement contains the name of the package."""
    if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == OLD:
        if found := _FROM.match(user.source.text, user.offset(node.lineno, node.col_offset)):
            yield found.start(1)
    elif isinstance(node, ast.Import):
        for name in node.names:
            if name.name.partition(".")[0] == OLD:
                yield user.offset(name.lineno, name.col_offset)


def _binds(node: ast.AST) -> bool:
    """Whether it is a statement like `import generated.interfaces`, which binds `generated`."""
    if not isinstance(node, ast.Import):
        return False
    return any(name.name.partition(".")[0] == OLD and not name.asname for name in node.names)


def _is_bound_otherwise(nodes: list[ast.AST], foreign: list[ast.AST]) -> bool:
    """Whether the name of the package may have another meaning in the module."""
    return any(
        (isinstance(node, ast.Name) and node.id == OLD and not isinstance(node.ctx, ast.Load))
        or (isinstance(node, ast.arg) and node.arg == OLD)
        or (_binds(node) and node in foreign)
        for node in nodes
    )


def _path_places(user: UserModule, nodes: list[ast.AST]) -> Iterator[tuple[ast.AST, int]]:
    """`... / "generated" / "scene.json"`: the string, and the position of the name in it."""
    for node in nodes:
        match node:
            case ast.BinOp(
                ast.BinOp(_, ast.Div(), ast.Constant(str(folder)) as constant),
                ast.Div(),
                ast.Constant(str(file)),
            ) if folder == OLD and _DATA.fullmatch(file):
                start = user.offset(constant.lineno, constant.col_offset)
                yield constant, user.source.text.index(OLD, start)


def _span(user: UserModule, node: ast.AST) -> Span:
    line, column = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
    start = user.offset(line, column)
    end = user.offset(
        getattr(node, "end_lineno", None) or line, getattr(node, "end_col_offset", None) or column
    )
    return user.source.span(start, end)

"""Adapt the import statements of old Python modules.

In: a module of the user, the names that can be imported. Out: text edits; findings about adapted
imports, and about names that only Qt or Ice provide.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.import_nodes import absolute_name, relative_imports
from robocomp_dsl.migrate.legacy import STAND_INS
from robocomp_dsl.migrate.qt_imports import (
    QT,
    adapted_from_import,
    adapted_import,
    is_qt,
    missing_in_qt6,
)
from robocomp_dsl.source import Span

GENERATED_MODULES = ("genericworker", "interfaces")
"""Modules that RoboComp generated next to the worker."""
_QT_NAME = re.compile(r"Q[A-Zt]\w+|Qt|qApp|Signal|Slot|SIGNAL|SLOT|Property|pyqt\w+")
INNER_MODELS = frozenset(("librobocomp_innermodel", "innermodel", "innermodel_python3"))
"""Modules and packages that had RoboComp's `InnerModel`."""
INNER_MODEL_NAMES = frozenset(("InnerModel", "InnerModelJoint", "InnerModelPrismaticJoint", "*"))
TextEdit = tuple[int, int, str]
"""Replace the text of [start, end)."""


@dataclass(frozen=True, slots=True)
class LegacyNames:
    """The importable names: the module for old names, the generated package, interface modules.

    `handlers` has the new name of each method that other components call.

    `states` are the suffixes of the state methods; None without a state machine. `servants` are
    modules that RoboComp generated, and that the runtime replaces. `has_window`: the component
    runs with Qt, so imports of Qt become imports of PySide6. `local` are the component's modules.

    Of the module that is adapted: `folders` are those below `src/`, `is_worker` whether it is the
    worker, which leaves `src/`.
    """

    legacy: str
    package: str
    modules: frozenset[str]
    handlers: Mapping[str, str]
    states: frozenset[str] | None = None
    servants: frozenset[str] = frozenset()
    has_window: bool = False
    local: frozenset[str] = frozenset()
    folders: tuple[str, ...] = ()
    is_worker: bool = False


def _used_attributes(tree: ast.Module) -> dict[str, set[str]]:
    """For each name, the attributes that are used; calls are `()` and `attribute()`."""
    used: dict[str, set[str]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            used.setdefault(node.value.id, set()).add(node.attr)
        elif isinstance(node, ast.Name):
            used.setdefault(node.id, set())
        elif isinstance(node, ast.Call):
            _add_call(node.func, used)
    return used


def _add_call(function: ast.expr, used: dict[str, set[str]]) -> None:
    if isinstance(function, ast.Name):
        used.setdefault(function.id, set()).add("()")
    elif isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
        used.setdefault(function.value.id, set()).add(f"{function.attr}()")


def adapt_imports(user: UserModule, names: LegacyNames, report: Report) -> Iterator[TextEdit]:
    """The edits of all statements that import names of RoboComp, Ice or Qt."""
    used = _used_attributes(user.tree)
    yield from _relative_import_edits(user, names, report)
    for node in ast.walk(user.tree):
        if isinstance(node, ast.Import):
            new = _plain_import(node, names, used)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            new = _from_import(node, names, used)
        else:
            continue
        span = span_of(user, node)
        if names.has_window and _imports_qt(node):
            if (missing := missing_in_qt6(node, used)) is not None:
                message = f"`{span.text:.80}` needs {missing}"
                report.add(codes.NEEDS_QT_OR_ICE, span, message)
            if new is None:
                continue
        if new is not None:
            if (
                isinstance(node, ast.ImportFrom)
                and not names.has_window
                and (missing := _unsupported_star_import(node, user, used))
            ):
                report.add(
                    codes.NEEDS_QT_OR_ICE, span, f"{missing} is available only with Qt or Ice"
                )
            report.add(codes.IMPORT_ADAPTED, span, f"`{span.text:.80}` became `{new:.80}`")
            yield span.start, span.end, new
        elif (missing := _unsupported_import(node, used)) is not None:
            report.add(
                codes.NEEDS_QT_OR_ICE,
                span,
                f"`{span.text:.80}` was not changed: it needs {missing}",
            )


def _imports_qt(node: ast.Import | ast.ImportFrom) -> bool:
    """Whether a statement imports from Qt."""
    if isinstance(node, ast.ImportFrom):
        return is_qt(node.module or "")
    return any(is_qt(alias.name) for alias in node.names)


def _plain_import(node: ast.Import, names: LegacyNames, used: dict[str, set[str]]) -> str | None:
    """The new text of `import a, b as c`; None if it needs no change."""
    statements = []
    changed = False
    for alias in node.names:
        bound = alias.asname or alias.name
        if alias.name in names.servants:
            changed = True
            continue
        if alias.name in INNER_MODELS - names.local:
            changed = True
            statements.append(f"from robocomp_dsl import innermodel as {bound}")
            continue
        is_generated = alias.name in GENERATED_MODULES
        is_provided = alias.name in names.modules or (
            alias.name == "Ice" and _unsupported_attribute("Ice", bound, used) is None
        )
        is_window = names.has_window and is_qt(alias.name)
        changed = changed or is_generated or is_provided or is_window
        suffix = f" as {alias.asname}" if alias.asname else ""
        if is_generated:
            statements.append(f"import {names.legacy} as {bound}")
        elif is_provided:
            statements.append(f"from {names.legacy} import {alias.name}{suffix}")
        elif is_window:
            statements.append(adapted_import(alias))
        else:
            statements.append(f"import {alias.name}{suffix}")
    return ("; ".join(statements) or "pass") if changed else None


def _from_import(node: ast.ImportFrom, names: LegacyNames, used: dict[str, set[str]]) -> str | None:
    """The new text of `from a import b`; None if it needs no change."""
    module = node.module or ""
    listed = ", ".join(a.name + (f" as {a.asname}" if a.asname else "") for a in node.names)
    if module in (*GENERATED_MODULES, *names.servants):
        return "pass" if module in names.servants else f"from {names.legacy} import {listed}"
    is_inner_model = module.partition(".")[0] in INNER_MODELS - names.local
    if is_inner_model and INNER_MODEL_NAMES.issuperset(a.name for a in node.names):
        return f"from robocomp_dsl.innermodel import {listed}"
    if module in names.modules:
        return f"from {names.package}.interfaces import {listed}"
    if names.has_window and is_qt(module):
        return adapted_from_import(node, names.legacy)
    if module.partition(".")[0] in QT and _unsupported_qt_name(node, used) is None:
        supported = [a for a in _expanded(node, used) if a.name in STAND_INS]
        listed = ", ".join(a.name + (f" as {a.asname}" if a.asname else "") for a in supported)
        return f"from {names.legacy} import {listed}" if supported else "pass"
    return None


def _relative_import_edits(
    user: UserModule, names: LegacyNames, report: Report
) -> Iterator[TextEdit]:
    for node in relative_imports(user.tree):
        if (new := _relative_import(node, names)) is not None:
            span = span_of(user, node)
            report.add(codes.IMPORT_ADAPTED, span, f"`{span.text:.80}` became `{new:.80}`")
            yield span.start, span.end, new


def _relative_import(node: ast.ImportFrom, names: LegacyNames) -> str | None:
    """The new text of `from .a import b` in a module of the package `src`."""
    module = absolute_name(node, names.folders)
    listed = ", ".join(a.name + (f" as {a.asname}" if a.asname else "") for a in node.names)
    if module in GENERATED_MODULES:
        return f"from {names.legacy} import {listed}"
    if module is None or not names.is_worker:
        return None
    return f"from {'.'.join(filter(None, ('src', module)))} import {listed}"


def _unsupported_star_import(
    node: ast.ImportFrom, user: UserModule, used: dict[str, set[str]]
) -> str | None:
    """A used name of `from genericworker import *` that has no stand-in; None if all have one."""
    if node.module not in GENERATED_MODULES or node.names[0].name != "*":
        return None
    aliases = [
        alias for statement in ast.walk(user.tree) for alias in getattr(statement, "names", [])
    ]
    imported = {a.asname or a.name for a in aliases if isinstance(a, ast.alias)}
    for name in sorted(STAND_INS.keys() - imported):
        if missing := _unsupported_attribute(name, name, used):
            return missing
    return None


def _unsupported_qt_name(node: ast.ImportFrom, used: dict[str, set[str]]) -> str | None:
    """A used name of an import from Qt that has no stand-in; None if all have one."""
    for alias in _expanded(node, used):
        bound = alias.asname or alias.name
        if alias.name in STAND_INS:
            if missing := _unsupported_attribute(alias.name, bound, used):
                return missing
        elif bound in used:
            return f"`{alias.name}`"
    return None


def _expanded(node: ast.ImportFrom, used: dict[str, set[str]]) -> list[ast.alias]:
    """The names that an import binds; of `import *` the used ones that look like those of Qt."""
    if node.names[0].name != "*":
        return node.names
    return [ast.alias(name) for name in sorted(used) if _QT_NAME.fullmatch(name)]


def _unsupported_attribute(name: str, bound: str, used: dict[str, set[str]]) -> str | None:
    """A used attribute that the stand-in `name`, bound as `bound`, lacks; None if none."""
    known, taken = STAND_INS[name], used.get(bound, set())
    extra = {attribute.removesuffix("()") for attribute in taken if attribute != "()"} - known
    return f"`{name}.{min(extra)}`" if extra else None


def _unsupported_import(node: ast.Import | ast.ImportFrom, used: dict[str, set[str]]) -> str | None:
    """Why an import of Qt or Ice cannot be replaced; None for any other import."""
    if isinstance(node, ast.ImportFrom):
        is_qt = (node.module or "").partition(".")[0] in QT
        return _unsupported_qt_name(node, used) if is_qt else None
    for alias in node.names:
        if alias.name.partition(".")[0] in QT:
            return "a module of Qt"
        if alias.name == "Ice":
            return _unsupported_attribute("Ice", alias.asname or alias.name, used)
    return None


def span_of(user: UserModule, node: ast.stmt | ast.expr) -> Span:
    """The source span of a syntax tree node."""
    start = user.offset(node.lineno, node.col_offset)
    return user.source.span(start, user.offset(node.end_lineno or 1, node.end_col_offset or 0))

"""Review names that are defined nowhere: they came with RoboComp's `genericworker`.

In: an old module in Python 3, the names that its star imports bring. Out: findings about names
that neither the module, nor Python, nor a star import defines. A module with a star import whose
names are not known here is left out.
"""

from __future__ import annotations

import ast
import builtins
import re
import symtable
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import standard_library
from robocomp_dsl.migrate.imports import GENERATED_MODULES, span_of
from robocomp_dsl.migrate.qt_imports import is_qt
from robocomp_dsl.migrate.worker_codes import DIFFERENT_PROCESS

PROVIDED = frozenset(
    [
        "GenericWorker",
        "Ice",
        "ROBOCOMP",
        "additionalPathStr",
        "icePaths",
        "inspect",
        "os",
        "preStr",
        "sys",
        "traceback",
    ]
)
"""Names that `legacy.py` has beside those of interfaces and Qt."""
_QT_NAME = re.compile(r"Q[A-Zt]\w*|Qt|qApp|Signal|Slot|SIGNAL|SLOT|Property|pyqt\w+|Ui_\w+")
"""Names of Qt; what is missing of them is reported with the import."""
_MODULE_NAMES = frozenset(("__file__", "__name__", "__doc__", "__builtins__", "WindowsError"))


def review_names(
    modules: Sequence[UserModule],
    names: Mapping[str, frozenset[str]],
    servants: frozenset[str],
    report: Report,
) -> None:
    """Report names that are defined nowhere.

    `names` are those of each interface module, `servants` the modules that RoboComp generated.
    """
    for module in modules:
        known = _star_names(module.tree, names, servants)
        if known is None:
            continue
        known |= set(dir(builtins)) | _MODULE_NAMES
        missing = set(_missing(module, known))
        for node in ast.walk(module.tree):
            if isinstance(node, ast.Name) and node.id in missing:
                missing.discard(node.id)
                message = f"`{node.id}` is defined nowhere: this line ends in a NameError"
                report.add(DIFFERENT_PROCESS, span_of(module, node), message)


def _star_names(
    tree: ast.Module, names: Mapping[str, frozenset[str]], servants: frozenset[str]
) -> set[str] | None:
    """The names that star imports bring; None if those of one are not known."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or node.names[0].name != "*":
            continue
        module = node.module or ""
        if module in GENERATED_MODULES:
            found |= PROVIDED | set(names) | set().union(*names.values())
        elif module in names:
            found |= names[module]
        elif module not in servants and not is_qt(module):
            if (public := _public_names(module)) is None:
                return None
            found |= public
    return found


def _public_names(module: str) -> set[str] | None:
    """The public names of a module of the standard library; None for others."""
    loaded = standard_library.load(module) if standard_library.is_known(module) else None
    if loaded is None:
        return None
    listed = getattr(loaded, "__all__", None)
    return set(listed or (name for name in dir(loaded) if not name.startswith("_")))


def _missing(module: UserModule, known: set[str]) -> Iterator[str]:
    """The global names that functions or the module read, and nobody binds."""
    try:
        table = symtable.symtable(module.source.text, "module", "exec")
    except SyntaxError:
        return
    bound = {s.get_name() for s in table.get_symbols() if s.is_assigned() or s.is_imported()}
    tables = [table]
    while tables:
        scope = tables.pop()
        tables += scope.get_children()
        for symbol in scope.get_symbols():
            if symbol.is_declared_global() and symbol.is_assigned():
                bound.add(symbol.get_name())
    tables = [table]
    while tables:
        scope = tables.pop()
        tables += scope.get_children()
        for symbol in scope.get_symbols():
            name = symbol.get_name()
            is_global = symbol.is_global() or (scope is table and not symbol.is_assigned())
            is_read = is_global and symbol.is_referenced()
            if is_read and name not in bound | known and not _QT_NAME.fullmatch(name):
                yield name

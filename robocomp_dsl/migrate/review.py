"""Review adapted Python code: what does not run as before is reported with its line.

In: the modules of a component that its worker imports. Out: findings about modules that are not
installed, names that the interfaces lack, methods with names of hooks, and code that depends on
RoboComp's process.
"""

from __future__ import annotations

import ast
import importlib.util
import sys
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import worker_codes
from robocomp_dsl.migrate.import_nodes import optional_nodes
from robocomp_dsl.migrate.imports import (
    GENERATED_MODULES,
    INNER_MODEL_NAMES,
    INNER_MODELS,
    span_of,
)
from robocomp_dsl.migrate.qt_imports import QT

HOOKS = frozenset(
    """emergency restore finalize deadline_missed publisher_lost
    publisher_alive""".split()  # noqa: SIM905
)
"""Methods of a component that the runtime calls, and RoboComp did not."""
_DISTRIBUTIONS = {
    "cv2": "opencv-python",
    "PIL": "pillow",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "usb": "pyusb",
    "yaml": "pyyaml",
}
"""Distributions whose names differ from those of their modules."""
_OLD_MODULES = {
    "ConfigParser": "configparser",
    "Queue": "queue",
    "StringIO": "io",
    "Tkinter": "tkinter",
    "cPickle": "pickle",
    "commands": "subprocess",
    "cStringIO": "io",
    "distutils": "setuptools",
    "imp": "importlib",
    "mutex": "threading.Lock",
    "sets": "set",
    "thread": "_thread",
    "urllib2": "urllib.request",
    "urlparse": "urllib.parse",
}
"""Modules that Python no longer has, and what replaces them."""
_PROCESS = {
    ("signal", "signal"): "signal handlers can be set in the main thread only, which is not that of"
    " the worker: write `def finalize(self)` for what ends the component",
    ("sys", "argv"): "`sys.argv` had the path of the configuration; now it has the options of"
    " `main.py`, and `self.config_file` is the configuration",
}


def review_modules(
    worker: UserModule,
    modules: Mapping[str, UserModule],
    names: Mapping[str, frozenset[str]],
    local_names: frozenset[str],
    report: Report,
) -> None:
    """Review the worker and the modules that it imports.

    `modules` are those of the component by dotted name, `names` the names of each interface
    module, `local_names` the names of all modules and packages in the component's folder.
    """
    for module in reachable(worker, modules):
        _review_imports(module, names, local_names, report)
        _review_interface_names(module, names, report)
        _review_process(module, report)
    if worker.worker is not None:
        _review_methods(worker, worker.worker, report)


def bare_names(modules: Sequence[UserModule], names: Mapping[str, frozenset[str]]) -> set[str]:
    """The names of interface modules that code uses without module, through `import *`."""
    used: set[str] = set()
    for module in modules:
        nodes = list(ast.walk(module.tree))
        if any(isinstance(n, ast.ImportFrom) and n.module in GENERATED_MODULES for n in nodes):
            used |= {n.id for n in nodes if isinstance(n, ast.Name)}
    return used & set().union(*names.values()) if names else set()


def reachable(worker: UserModule, modules: Mapping[str, UserModule]) -> Iterator[UserModule]:
    """The worker and the modules of the component that it imports, directly or not."""
    pending, seen = [worker], {id(worker)}
    while pending:
        module = pending.pop(0)
        yield module
        for name in _imported(module.tree):
            found = modules.get(name.removeprefix("src."))
            if found is not None and id(found) not in seen:
                seen.add(id(found))
                pending.append(found)


def _imported(tree: ast.Module) -> Iterator[str]:
    """The dotted names of imported modules, and of names that may be modules."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = node.module or ""
            yield package
            prefix = f"{package}." if package else ""
            yield from (f"{prefix}{alias.name}" for alias in node.names)


def _review_imports(
    module: UserModule,
    names: Mapping[str, frozenset[str]],
    local_names: frozenset[str],
    report: Report,
) -> None:
    """Report imports of modules that are neither in the folder nor installed."""
    optional = set(optional_nodes(module.tree))
    for node in ast.walk(module.tree):
        if node in optional or not isinstance(node, ast.Import | ast.ImportFrom):
            continue
        if isinstance(node, ast.ImportFrom):
            tops = [] if node.level else [(node.module or "").partition(".")[0]]
        else:
            tops = [alias.name.partition(".")[0] for alias in node.names]
        for top in tops:
            if top.startswith("RoboComp") and top not in names:
                message = f"no interface of the component is in the module `{top}`"
                report.add(worker_codes.MISSING_NAME, span_of(module, node), message)
            elif top in INNER_MODELS - local_names and _is_known_inner_model(node):
                continue
            elif not _is_available(top, names, local_names):
                message = f"`{top}` is not installed here; the component does not start without it"
                fix = f"install it for the component: pip install {_DISTRIBUTIONS.get(top, top)}"
                if top in _OLD_MODULES:
                    fix = f"it is a module of Python 2; use `{_OLD_MODULES[top]}`"
                report.add(worker_codes.MISSING_MODULE, span_of(module, node), message, help=fix)


def _is_known_inner_model(node: ast.Import | ast.ImportFrom) -> bool:
    """Whether an import of RoboComp's `InnerModel` was replaced."""
    return isinstance(node, ast.Import) or INNER_MODEL_NAMES.issuperset(a.name for a in node.names)


def _is_available(
    name: str, names: Mapping[str, frozenset[str]], local_names: frozenset[str]
) -> bool:
    known = (*GENERATED_MODULES, *QT, "Ice", "src", "robocomp_dsl", "")
    if name in known or name in names or name in local_names or name in sys.stdlib_module_names:
        return True
    try:
        return importlib.util.find_spec(name) is not None
    except (ImportError, ValueError):
        return False


def _review_interface_names(
    module: UserModule, names: Mapping[str, frozenset[str]], report: Report
) -> None:
    """Report `RoboCompLaser.TData` if the module has no such name."""
    for node in ast.walk(module.tree):
        missing: tuple[str, str] | None = None
        match node:
            case ast.Attribute(
                attr=attribute, value=ast.Name(id=owner) | ast.Attribute(attr=owner)
            ) if owner in names and attribute not in names[owner]:
                missing = (owner, attribute)
            case ast.ImportFrom(module=str(owner)) if owner in names:
                lacking = [a.name for a in node.names if a.name not in {"*", *names[owner]}]
                missing = (owner, lacking[0]) if lacking else None
            case ast.Attribute(attr=attribute, value=ast.Name()) if (
                attribute.startswith("RoboComp") and attribute not in names
            ):
                missing = ("", attribute)
        if missing is not None and isinstance(node, ast.expr | ast.stmt):
            owner, attribute = missing
            message = (
                f"`{owner}` has no `{attribute}` in the IDSL file that was found"
                if owner
                else f"no interface of the component is in the module `{attribute}`"
            )
            report.add(worker_codes.MISSING_NAME, span_of(module, node), message)


def _review_process(module: UserModule, report: Report) -> None:
    replaced = set(_replaced_handlers(module.tree))
    for node in ast.walk(module.tree):
        match node:
            case _ if node in replaced:
                continue
            case ast.Attribute(value=ast.Name(id=owner), attr=attribute):
                reason = _PROCESS.get((owner, attribute))
                if reason:
                    report.add(worker_codes.DIFFERENT_PROCESS, span_of(module, node), reason)


def _replaced_handlers(tree: ast.Module) -> Iterator[ast.expr]:
    """`signal.signal(signal.SIGINT, …)` at the margin: as in RoboComp `main` replaces it.

    The module is loaded in the main thread, and before the main program sets its own handler.
    """
    for statement in tree.body:
        match statement:
            case ast.Expr(
                value=ast.Call(func=function, args=[ast.Attribute(attr="SIGINT"), ast.Attribute()])
            ):
                yield function


def _review_methods(user: UserModule, worker: ast.ClassDef, report: Report) -> None:
    """Report methods that the runtime calls, and RoboComp did not."""
    for node in worker.body:
        if isinstance(node, ast.FunctionDef) and node.name in HOOKS:
            message = f"RoboComp did not call `{node.name}`; the new component does: rename it"
            report.add(worker_codes.HOOK_NAME, user.span_of(node), message)

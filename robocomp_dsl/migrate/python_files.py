"""Migrate the Python files of a component.

In: the files of the folder, the new component. Out: each file with its path in the new folder.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component_files import ComponentFile, FileCategory, is_main_script
from robocomp_dsl.migrate.import_nodes import relative_imports
from robocomp_dsl.migrate.infer import InferredParameters
from robocomp_dsl.migrate.legacy import interface_names, legacy_text
from robocomp_dsl.migrate.python_sources import read_modules
from robocomp_dsl.migrate.review import bare_names, reachable, review_modules
from robocomp_dsl.migrate.review_fields import review_fields
from robocomp_dsl.migrate.review_names import review_names
from robocomp_dsl.migrate.review_ports import review_ports
from robocomp_dsl.migrate.review_versions import review_versions
from robocomp_dsl.migrate.worker import adapt_module, names_for, period_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.source import MAX_BYTES, Source, Span

WORKER = "specificworker.py"
SOURCE = "src"
_FROM_SRC = re.compile(r"^[ \t]*(?:from|import)[ \t]+src\b", re.MULTILINE)
_VARIABLE = re.compile(r"['\"]ROBOCOMP['\"]")

MigratedFile = tuple[OutputFile, str]
"""A new file and the path of the old one."""


def find_period(path: Path) -> tuple[int, Span] | None:
    """The period [ms] that a worker sets, and its position; None if it sets none."""
    user = read_modules([path], Report())[path]
    return period_of(user) if user else None


def migrate_python_files(
    component: Component,
    files: Sequence[ComponentFile],
    parameters: InferredParameters,
    report: Report,
) -> Iterator[MigratedFile]:
    """The worker, its modules, and the module `legacy` that replaces RoboComp's modules."""
    workers = [file for file in files if file.category is FileCategory.WORKER]
    worker = max(workers, key=lambda file: len(file.relative.parts), default=None)
    module_files = [
        file
        for file in files
        if file.category is FileCategory.MODULE and not is_main_script(file, component.name)
    ]
    everything = [*([worker] if worker else []), *module_files]
    modules = read_modules([file.path for file in everything], report)
    user = modules[worker.path] if worker else None
    if worker is None or user is None or user.worker is None:
        _report_missing_worker(component, files, worker, user, report)
    readable = [module for module in modules.values() if module]
    taken = {file.relative.name for file in module_files}
    legacy = "legacy"
    while f"{legacy}.py" in taken:
        legacy = f"robocomp_{legacy}"
    local = frozenset(name.removesuffix(".py") for name in taken)
    local |= {part for file in module_files for part in file.relative.parent.parts}
    names = replace(names_for(component, legacy), local=local)
    in_source = any(map(_depends_on_place, readable))
    if user:
        _review(component, user, files, module_files, modules, report)
    if worker and user is None:
        yield _copy_bytes(worker, f"{WORKER}.old")
    elif worker and user:
        first = _first_line(
            legacy, readable, in_source=in_source and len(worker.relative.parts) > 1
        )
        text = adapt_module(user, replace(names, is_worker=True), report, first)
        yield OutputFile(WORKER, text, encoding=user.encoding), str(worker.relative)
    if user or module_files:
        bare = bare_names(readable, interface_names(component))
        text = legacy_text(component, parameters, source=in_source, bare=bare)
        yield OutputFile(f"{legacy}.py", text), "(RoboComp's modules)"
    for file in module_files:
        place = str(file.relative if in_source else file.relative.relative_to(SOURCE))
        module = modules[file.path]
        if module is None:
            yield _copy_bytes(file, place)
        else:
            folders = file.relative.relative_to(SOURCE).parent.parts
            text = adapt_module(module, replace(names, folders=folders), report)
            yield OutputFile(place, text, encoding=module.encoding), str(file.relative)


def _depends_on_place(module: UserModule) -> bool:
    """Whether a module names the folder `src/`, or its own path, or is part of a package."""
    return (
        bool(_FROM_SRC.search(module.source.text))
        or any(
            isinstance(node, ast.Name) and node.id == "__file__" for node in ast.walk(module.tree)
        )
        or (module.source.path.parent.name == SOURCE and any(relative_imports(module.tree)))
    )


def _first_line(legacy: str, modules: Sequence[UserModule], *, in_source: bool) -> str:
    """The line that the worker needs before its other imports; empty if it needs none."""
    if in_source:
        return f"import {legacy}; __file__ = {legacy}.SOURCE_FILE  # the worker was in src/"
    if any(_VARIABLE.search(module.source.text) for module in modules):
        return f"import {legacy}  # sets $ROBOCOMP"
    return ""


def _review(
    component: Component,
    user: UserModule,
    files: Sequence[ComponentFile],
    module_files: Sequence[ComponentFile],
    modules: dict[Path, UserModule | None],
    report: Report,
) -> None:
    by_name = {
        ".".join(file.relative.relative_to(SOURCE).with_suffix("").parts).removesuffix(
            ".__init__"
        ): modules[file.path]
        for file in module_files
    }
    paths = [file.relative for file in files if file.category is not FileCategory.REPLACED]
    local_names = {path.stem for path in paths if path.suffix in (".py", ".so", ".pyd")}
    local_names |= {part for path in paths for part in path.parent.parts}
    if component.gui:
        local_names |= {f"ui_{path.stem}" for path in paths if path.suffix == ".ui"}
    review_ports(user, component, report)
    readable = {name: module for name, module in by_name.items() if module}
    imported = list(reachable(user, readable))
    review_fields(imported, component, report)
    review_versions(imported, report)
    servants = names_for(component, "").servants
    review_names(imported, interface_names(component), servants, report)
    review_modules(
        user,
        readable,
        interface_names(component),
        frozenset(local_names | servants),
        report,
    )


def _report_missing_worker(
    component: Component,
    files: Sequence[ComponentFile],
    worker: ComponentFile | None,
    user: UserModule | None,
    report: Report,
) -> None:
    """Report why the new worker has empty methods, unless another finding says so."""
    in_cpp = any(file.category is FileCategory.CODE for file in files)
    if in_cpp or (worker is not None and user is None):
        return
    source = user.source if user else Source(component.path, "")
    message = f"the worker of {component.name} is empty: there is no class SpecificWorker"
    report.add(codes.NO_WORKER, source.file_span, message)


def _copy_bytes(file: ComponentFile, place: str) -> MigratedFile:
    """A file copied byte by byte."""
    try:
        with open_regular(file.path) as stream:
            data = stream.read(MAX_BYTES)
    except OSError:
        data = b""
    return OutputFile(place, data.decode("utf-8", "surrogateescape")), str(file.relative)

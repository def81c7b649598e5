"""Migrate the Python files of a component.

In: the files of the folder, the new component. Out: each file with its path in the new folder.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.regeneration import user_module
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component_files import ComponentFile, FileCategory
from robocomp_dsl.migrate.infer import InferredParameters
from robocomp_dsl.migrate.legacy import legacy_text
from robocomp_dsl.migrate.worker import adapt_module, names_for, period_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

WORKER = "specificworker.py"
_PYTHON_2 = re.compile(
    r"^\s*(?:print\s+[^\s(=]|except\s+[\w.]+\s*,\s*\w+\s*:|raise\s+\w+\s*,|exec\s+['\"])",
    re.MULTILINE,
)
"""Statements that exist only in Python 2."""
_FROM_SRC = re.compile(r"^[ \t]*(?:from|import)[ \t]+src\b", re.MULTILINE)

MigratedFile = tuple[OutputFile, str]
"""A new file and the path of the old one."""


def find_period(path: Path) -> tuple[int, Span] | None:
    """The period [ms] that a worker sets, and its position; None if it sets none."""
    user = _read_module(path, Report())
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
    user = _read_module(worker.path, report) if worker else None
    if worker is None or user is None or user.worker is None:
        _report_missing_worker(component, files, worker, user, report)
    modules = [
        file
        for file in files
        if file.category is FileCategory.MODULE and not _is_script(file, component)
    ]
    taken = {file.relative.name for file in modules}
    legacy = "legacy"
    while f"{legacy}.py" in taken:
        legacy = f"robocomp_{legacy}"
    names = names_for(component, legacy)
    if worker and user is None:
        yield _copy_bytes(worker, f"{WORKER}.old")
    elif worker and user:
        yield (
            OutputFile(WORKER, adapt_module(user, names, report), encoding=user.encoding),
            str(worker.relative),
        )
    if user or modules:
        yield OutputFile(f"{legacy}.py", legacy_text(component, parameters)), "(RoboComp's modules)"
    below = bool(user and _FROM_SRC.search(user.source.text))
    for file in modules:
        place = str(file.relative if below else file.relative.relative_to("src"))
        module = _read_module(file.path, report)
        if module is None:
            yield _copy_bytes(file, place)
        else:
            text = adapt_module(module, names, report)
            yield OutputFile(place, text, encoding=module.encoding), str(file.relative)


def _is_script(file: ComponentFile, component: Component) -> bool:
    """Whether a file is the old main program, which is named like the component."""
    return file.relative.parts == ("src", f"{component.name}.py")


def _report_missing_worker(
    component: Component,
    files: Sequence[ComponentFile],
    worker: ComponentFile | None,
    user: user_module.UserModule | None,
    report: Report,
) -> None:
    """Report why the new worker has empty methods, unless another finding says so."""
    in_cpp = any(file.category is FileCategory.CODE for file in files)
    if in_cpp or (worker is not None and user is None):
        return
    source = user.source if user else Source(component.path, "")
    message = f"the worker of {component.name} is empty: there is no class SpecificWorker"
    report.add(codes.NO_WORKER, source.file_span, message)


def _read_module(path: Path, report: Report) -> user_module.UserModule | None:
    """Parse a module; None, with a finding, if Python cannot parse it."""
    syntax_report = Report()
    try:
        user = user_module.read(path, syntax_report)
    except UnreadableSource as error:
        report.add(
            codes.UNREADABLE_PYTHON, Source(path, "").file_span, f"the file cannot be used: {error}"
        )
        return None
    if user is None:
        for finding in syntax_report:
            old = _PYTHON_2.search(finding.span.source.text)
            message = f"this is Python 2: convert a copy with `2to3 -w -n {path.name}`"
            fix = f"{message}; then migrate the copy" if old else ""
            report.add(codes.UNREADABLE_PYTHON, finding.span, finding.message, help=fix)
    return user


def _copy_bytes(file: ComponentFile, place: str) -> MigratedFile:
    """A file copied byte by byte."""
    try:
        with open_regular(file.path) as stream:
            data = stream.read(MAX_BYTES)
    except OSError:
        data = b""
    return OutputFile(place, data.decode("utf-8", "surrogateescape")), str(file.relative)

"""The Python files of an old component, on their way.

In: the files that were found, the new component. Out: each with its place in the new folder.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.upkeep import user_module
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.folder import Fate, Found
from robocomp_dsl.migrate.infer import Parameters
from robocomp_dsl.migrate.legacy import legacy_text
from robocomp_dsl.migrate.worker import adapted, names_for, period_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

WORKER = "specificworker.py"
_PYTHON_2 = re.compile(
    r"^\s*(?:print\s+[^\s(=]|except\s+[\w.]+\s*,\s*\w+\s*:|raise\s+\w+\s*,|exec\s+['\"])",
    re.MULTILINE,
)
"""Statements that only Python 2 has."""
_FROM_SRC = re.compile(r"^[ \t]*(?:from|import)[ \t]+src\b", re.MULTILINE)

Placed = tuple[OutputFile, str]
"""A file, and what it was in the old folder."""


def period_in(path: Path) -> tuple[int, Span] | None:
    """The period that a worker sets itself, and where."""
    user = _read(path, Report())
    return period_of(user) if user else None


def carried_over(
    component: Component, found: Sequence[Found], parameters: Parameters, report: Report
) -> Iterator[Placed]:
    """The worker, the modules beside it, and the module that both import instead of RoboComp's."""
    workers = [one for one in found if one.fate is Fate.WORKER]
    worker = max(workers, key=lambda one: len(one.relative.parts), default=None)
    user = _read(worker.path, report) if worker else None
    if worker is None or user is None or user.worker is None:
        _tell_empty(component, found, worker, user, report)
    modules = [one for one in found if one.fate is Fate.MODULE and not _is_script(one, component)]
    taken = {one.relative.name for one in modules}
    legacy = "legacy"
    while f"{legacy}.py" in taken:
        legacy = f"robocomp_{legacy}"
    names = names_for(component, legacy)
    if worker and user is None:
        yield _raw(worker, f"{WORKER}.old")
    elif worker and user:
        yield (
            OutputFile(WORKER, adapted(user, names, report), encoding=user.encoding),
            str(worker.relative),
        )
    if user or modules:
        yield OutputFile(f"{legacy}.py", legacy_text(component, parameters)), "(RoboComp's modules)"
    below = bool(user and _FROM_SRC.search(user.source.text))
    for one in modules:
        place = str(one.relative if below else one.relative.relative_to("src"))
        module = _read(one.path, report)
        if module is None:
            yield _raw(one, place)
        else:
            text = adapted(module, names, report)
            yield OutputFile(place, text, encoding=module.encoding), str(one.relative)


def _is_script(one: Found, component: Component) -> bool:
    """Whether it is the old main program, which is called as the component."""
    return one.relative.parts == ("src", f"{component.name}.py")


def _tell_empty(
    component: Component,
    found: Sequence[Found],
    worker: Found | None,
    user: user_module.UserModule | None,
    report: Report,
) -> None:
    """Why the new worker has empty methods, unless that was told already."""
    in_cpp = any(one.fate is Fate.CODE for one in found)
    if in_cpp or (worker is not None and user is None):
        return
    source = user.source if user else Source(component.path, "")
    said = f"the worker of {component.name} is empty: there is no class SpecificWorker"
    report.add(codes.NO_WORKER, source.whole, said)


def _read(path: Path, report: Report) -> user_module.UserModule | None:
    """A module that Python can read; None for another one, which is told."""
    found = Report()
    try:
        user = user_module.read(path, found)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_PYTHON, Source(path, "").whole, f"it cannot be used: {error}")
        return None
    if user is None:
        for one in found:
            old = _PYTHON_2.search(one.span.source.text)
            said = f"it is Python 2: `2to3 -w -n {path.name}` brings a copy of it to Python 3"
            way_out = f"{said}; then migrate that" if old else ""
            report.add(codes.UNREADABLE_PYTHON, one.span, one.message, help=way_out)
    return user


def _raw(one: Found, place: str) -> Placed:
    """A file byte by byte."""
    try:
        with one.path.open("rb") as stream:
            data = stream.read(MAX_BYTES)
    except OSError:
        data = b""
    return OutputFile(place, data.decode("utf-8", "surrogateescape")), str(one.relative)

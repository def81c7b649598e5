"""Regeneration: what becomes of the user's files when the descriptions have changed.

In: a component, the files that generation gives, and the folder with what the user made of the
former ones. Out: the files to write, and findings about the user's code. Nothing is written here.

`specificworker.py` only ever grows: a stub for each operation without a method. The other files
that are written once are merged three ways with their pristine output, which `.rcgen/` keeps.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.component_names import names_of
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.upkeep import judge, members_used, merge, record, stubs, user_module
from robocomp_dsl.generate.upkeep.methods import Method, methods_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import UnreadableSource

WORKER = "specificworker.py"


def keep_up(
    folder: Path, component: Component, files: Sequence[OutputFile], report: Report
) -> list[OutputFile]:
    """`files` as they are to be written over what `folder` holds; `report` gets the findings."""
    called = names_of(component)
    methods = methods_of(component, called)
    known = record.read(folder, report)
    others = [one for one in files if one.path != WORKER]
    made = [one for one in files if one.path == WORKER]
    try:
        user = user_module.read(folder / WORKER, report)
    except UnreadableSource as error:
        report.extend(user_module.unreadable(folder / WORKER, error))
        user = None
    if user is not None:
        missing = list(judge.judge(user, methods, known, report))
        made = list(_with_stubs(user, missing, report)) or made
        members_used.judge(user, component, called, report)
    kept = record.written(methods, known, user)
    return [*made, *merge.merged(folder, others, report), kept]


def _with_stubs(
    user: user_module.UserModule, missing: Sequence[Method], report: Report
) -> Iterator[OutputFile]:
    """The user's module with a stub for each of the `missing` methods, if there are any."""
    if not missing:
        return
    if user.source.path.is_symlink():
        judge.report_missing(user, missing, report)
        return
    added = stubs.added(user, missing)
    stubs.report_added(user, added, missing, report)
    yield OutputFile(WORKER, added, encoding=user.encoding, seen=user.data)

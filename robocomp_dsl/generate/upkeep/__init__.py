"""Regeneration: what becomes of the user's files when the descriptions have changed.

In: a component, the files that generation gives, and the folder with what the user made of the
former ones. Out: the files to write, and findings about the user's code. Nothing is written here.

`specificworker.py` only ever grows: a stub for each operation without a method. The other files
that are written once are merged three ways with their pristine output, which `.rcgen/` keeps.
"""

from __future__ import annotations

import stat
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.component_names import names_of
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.upkeep import (
    events_used,
    hooks_used,
    judge,
    members_used,
    merge,
    record,
    stubs,
    user_module,
)
from robocomp_dsl.generate.upkeep.methods import Method, methods_of
from robocomp_dsl.generate.upkeep.user_module import UserModule
from robocomp_dsl.generate.worker import machine_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import UnreadableSource

WORKER = "specificworker.py"


def keep_up(
    folder: Path,
    component: Component,
    files: Sequence[OutputFile],
    report: Report,
    *,
    writes: bool = True,
) -> list[OutputFile]:
    """`files` as they are to be written over what `folder` holds; `report` gets the findings.

    Without `writes` the findings say what would be done, at places in the files as they are.
    """
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
        kept = "" if writes else "a stub would be added"
        made = list(_with_stubs(user, missing, methods, kept, report)) or made
        members_used.judge(user, component, called, report)
        machine = machine_of(component)
        given = component.parameters.parameters if component.parameters else ()
        events_used.judge(user, machine, report)
        hooks_used.judge(user, given, machine, known.keys() | methods.keys(), report)
    # What Python cannot read now is judged by the old record when it is mended.
    unread = any(one.code is codes.UNREADABLE_WORKER for one in report)
    recorded = record.file_of(known if unread else record.of_now(methods, known, user))
    return [*made, *merge.merged(folder, others, report, writes=writes), recorded]


def _with_stubs(
    user: UserModule,
    missing: Sequence[Method],
    methods: Mapping[str, Method],
    kept: str,
    report: Report,
) -> Iterator[OutputFile]:
    """The user's module with a stub for each of the `missing` methods, if there are any."""
    if not missing:
        return
    if why := _untouchable(user):
        judge.report_missing(user, missing, methods, f"{why}, so none is added", report)
        return
    added = stubs.added(user, missing)
    if kept:
        judge.report_missing(user, missing, methods, kept, report)
    else:
        stubs.report_added(user, added, missing, methods, report)
    yield OutputFile(WORKER, added, encoding=user.encoding, seen=user.data)


def _untouchable(user: UserModule) -> str:
    """Why no stubs can be put into the user's class; nothing where they can."""
    path = user.source.path
    if path.is_symlink():
        return "the file is a link"
    if not path.stat().st_mode & stat.S_IWUSR:
        return "the file is read-only"
    if user.hierarchy.unknown:
        return f"what its base `{user.hierarchy.unknown[0]}` has cannot be seen here"
    if user.worker is None:
        return f"its class does not stand at the margin of `{WORKER}`"
    return ""

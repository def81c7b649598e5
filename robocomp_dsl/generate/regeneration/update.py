"""Regeneration: updates the user's files after the descriptions have changed.

In: a component, its generated files, and the folder with the user's files. Out: the files to write,
and findings about the user's code. Nothing is written here.

`specificworker.py` only grows: a stub is appended for each operation without a method. The other
files that are written once are merged three ways with their pristine output in `.rcgen/`.
"""

from __future__ import annotations

import stat
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.python.component_names import names_of
from robocomp_dsl.generate.python.worker import machine_of
from robocomp_dsl.generate.regeneration import (
    compare_signatures,
    manifest,
    merge,
    package_rename,
    stubs,
    unknown_events,
    unknown_hooks,
    unknown_members,
    user_module,
)
from robocomp_dsl.generate.regeneration.methods import Method, methods_of
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Source, UnreadableSource

WORKER = "specificworker.py"
FORM = "mainUI.ui"


def update_user_files(
    folder: Path,
    component: Component,
    files: Sequence[OutputFile],
    report: Report,
    *,
    writes: bool = True,
    methods: Mapping[str, Method] | None = None,
    recorded: str = manifest.FILE,
) -> list[OutputFile]:
    """The files to write over those in `folder`; `report` gets the findings.

    Without `writes` the findings describe what would be done, at locations in the current files.
    `methods` are those that the user's class should have, the default is those of the operations
    and states; `recorded` is the file in which their signatures are recorded.
    """
    py_names = names_of(component)
    files = package_rename.renamed(folder, py_names.package, files, report)
    methods = methods_of(component, py_names) if methods is None else methods
    known = manifest.read(folder, report, recorded)
    others = [file for file in files if file.path != WORKER and not _is_replaced(file, folder)]
    worker_files = [file for file in files if file.path == WORKER]
    try:
        user = user_module.read(folder / WORKER, report)
        user = _with_new_imports(user, worker_files)
    except UnreadableSource as error:
        report.extend(user_module.unreadable(folder / WORKER, error))
        user = None
    if user is not None:
        missing = list(compare_signatures.missing_methods(user, methods, known, report))
        why_not_written = "" if writes else "a stub would be added"
        worker_files = (
            list(_with_stubs(user, missing, methods, why_not_written, py_names.package, report))
            or worker_files
        )
        unknown_members.report_unknown_members(user, component, py_names, report)
        machine = machine_of(component)
        parameters = component.parameters.parameters if component.parameters else ()
        unknown_events.report_unknown_events(user, machine, report)
        unknown_hooks.report_unknown_hooks(
            user, parameters, machine, known.keys() | methods.keys(), report
        )
    # While Python cannot parse the file, its old entries stay for the time when it is fixed.
    unread = any(finding.code is codes.UNREADABLE_WORKER for finding in report)
    signatures = known if unread else manifest.of_now(methods, known, user)
    record = manifest.file_of(signatures, recorded)
    return [*worker_files, *merge.merged(folder, others, report, writes=writes), record]


def _is_replaced(file: OutputFile, folder: Path) -> bool:
    """Whether the folder has the form of the window where RoboComp has it."""
    return file.path == FORM and (folder / "src" / FORM).is_file()


def _with_new_imports(
    user: UserModule | None, worker_files: Sequence[OutputFile]
) -> UserModule | None:
    """The user's module as it will be with imports from the new package."""
    changed = next((file for file in worker_files if file.expected_bytes is not None), None)
    if user is None or changed is None:
        return user
    return user_module.parsed(Source(user.source.path, changed.text), user.data, user.encoding)


def _with_stubs(
    user: UserModule,
    missing: Sequence[Method],
    methods: Mapping[str, Method],
    why_not_written: str,
    package: str,
    report: Report,
) -> Iterator[OutputFile]:
    """The user's module with a stub for each of the `missing` methods, if there are any."""
    if not missing:
        return
    if why := _read_only_reason(user):
        compare_signatures.report_missing(
            user, missing, methods, f"{why}, so none is added", package, report
        )
        return
    added = stubs.added(user, missing, package)
    if why_not_written:
        compare_signatures.report_missing(user, missing, methods, why_not_written, package, report)
    else:
        stubs.report_added(user, added, missing, methods, report)
    yield OutputFile(WORKER, added, encoding=user.encoding, expected_bytes=user.data)


def _read_only_reason(user: UserModule) -> str:
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

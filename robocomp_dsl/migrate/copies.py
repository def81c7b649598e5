"""Copy the other files of an old component; report those that have no replacement.

In: the files of the folder. Out: copies in the new component, findings about the others.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component_files import ComponentFile, FileCategory, is_main_script
from robocomp_dsl.migrate.migrated_component import MigratedComponent
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.source import MAX_BYTES, Source, UnreadableSource, read_source_bytes

_NOT_MIGRATED = {
    FileCategory.CODE: (codes.NOT_PYTHON, "C++ code is not migrated"),
    FileCategory.WINDOW: (codes.QT_WINDOW, "the Qt window is not migrated"),
    FileCategory.LINK: (codes.NOT_COPIED, "it is a link or not a regular file; it was not copied"),
    FileCategory.TOO_MANY: (
        codes.NOT_COPIED,
        "too many files; this file and all later ones were not copied",
    ),
}


def is_generated_file(path: str) -> bool:
    """Whether `rcgen component` rewrites the file."""
    return path == "main.py" or "_generated/" in path


def copy_all(moved: MigratedComponent, files: Sequence[ComponentFile], report: Report) -> None:
    """Copy the other files, and report files without a replacement."""
    room = 16 * MAX_BYTES
    modules = [f for f in files if f.category in (FileCategory.WORKER, FileCategory.MODULE)]
    for file in files:
        rejection = _rejection(file, moved)
        if rejection is not None:
            report.add(rejection[0], Source(file.path, "").file_span, rejection[1])
        elif file.category in (FileCategory.COPY, FileCategory.WINDOW) or (
            file.category is FileCategory.CONFIG and is_read_by_code(file, modules)
        ):
            room -= _copy(moved, file, room, report)


def is_read_by_code(config: ComponentFile, modules: Sequence[ComponentFile]) -> bool:
    """Whether a module names a configuration, as `etc/config` or `join("etc", "config")`."""
    name = re.escape(config.relative.name)
    named = re.compile(rf"""etc(?:/|['"][\s)]*[,/]\s*['"])/?{name}['"]""".encode())
    return any(named.search(_bytes_of(module)) for module in modules)


def _bytes_of(file: ComponentFile) -> bytes:
    """The bytes of a file; none if it cannot be read, which is reported elsewhere."""
    try:
        return read_source_bytes(file.path)
    except UnreadableSource:
        return b""


def _rejection(file: ComponentFile, moved: MigratedComponent) -> tuple[Code, str] | None:
    """The finding about a file that is not copied; None for a file to copy."""
    if file.category is FileCategory.WINDOW and moved.has_window:
        return None
    script = file.category is FileCategory.MODULE and is_main_script(file, moved.name)
    if file.category is FileCategory.REPLACED or script:
        return codes.GENERATED_FILE_DROPPED, f"`{file.relative}` has no replacement"
    spare = file.category is FileCategory.DESCRIPTION and file.relative.suffix != ".idsl"
    if spare and file.relative.name != moved.description:
        return codes.NOT_COPIED, f"`{file.relative}` was not copied: another description is in use"
    return _NOT_MIGRATED.get(file.category)


def _copy(moved: MigratedComponent, file: ComponentFile, room: int, report: Report) -> int:
    """Copy a file unchanged; its size in bytes."""
    name = str(file.relative)
    data, problem = b"", ""
    try:
        with open_regular(file.path) as stream:
            data = stream.read(min(MAX_BYTES, room) + 1)
    except OSError as error:
        problem = error.strerror or str(error)
    if len(data) > min(MAX_BYTES, room):
        problem = "it is too large"
    elif any(existing.path == name for existing in moved.files) or is_generated_file(name):
        problem = "the new component has another file of this name"
    if problem:
        report.add(
            codes.NOT_COPIED, Source(file.path, "").file_span, f"it was not copied: {problem}"
        )
        return 0
    moved.add(OutputFile(name, data.decode("utf-8", "surrogateescape")), name)
    return len(data)

"""The files of an old component that are copied as they are, and those without a successor.

In: the files that were found. Out: copies in the new component, findings about the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePosixPath

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.folder import Fate, Found
from robocomp_dsl.migrate.moved import Moved
from robocomp_dsl.source import MAX_BYTES, Source

_WITHOUT_SUCCESSOR = {
    Fate.CODE: (codes.NOT_PYTHON, "code in C++ is not carried over"),
    Fate.WINDOW: (codes.INTERFACE_WINDOW, "the window is not carried over"),
    Fate.LINK: (codes.NOT_COPIED, "it is a link or no file, and was not copied"),
    Fate.TOO_MANY: (codes.NOT_COPIED, "there are too many files; from here on none was copied"),
}


def is_written(path: str) -> bool:
    """Whether generation rewrites a file each time."""
    return path == "main.py" or path.startswith("generated/")


def copy_all(moved: Moved, found: Sequence[Found], report: Report) -> None:
    """The other files, and what has no successor."""
    room = 16 * MAX_BYTES
    for one in found:
        told = _judged(one, moved)
        if told is not None:
            report.add(told[0], Source(one.path, "").whole, told[1])
        elif one.fate is Fate.COPY:
            room -= _copy(moved, one, room, report)


def _judged(one: Found, moved: Moved) -> tuple[Code, str] | None:
    """The finding about a file that has no successor."""
    script = one.relative == PurePosixPath("src", f"{moved.name}.py")
    if one.fate is Fate.REPLACED or (script and one.fate is Fate.MODULE):
        return codes.REPLACED, f"`{one.relative}` has no successor"
    spare = one.fate is Fate.DESCRIPTION and one.relative.suffix != ".idsl"
    if spare and one.relative.name != moved.description:
        return codes.NOT_COPIED, f"`{one.relative}` was not copied: the component has another one"
    return _WITHOUT_SUCCESSOR.get(one.fate)


def _copy(moved: Moved, one: Found, room: int, report: Report) -> int:
    """Copy a file as it is; its size."""
    name = str(one.relative)
    data, said = b"", ""
    try:
        with one.path.open("rb") as stream:
            data = stream.read(min(MAX_BYTES, room) + 1)
    except OSError as error:
        said = error.strerror or str(error)
    if len(data) > min(MAX_BYTES, room):
        said = "it is too large"
    elif any(file.path == name for file in moved.files) or is_written(name):
        said = "there is another file of this name in the new component"
    if said:
        report.add(codes.NOT_COPIED, Source(one.path, "").whole, f"it was not copied: {said}")
        return 0
    moved.add(OutputFile(name, data.decode("utf-8", "surrogateescape")), name)
    return len(data)

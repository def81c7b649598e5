"""`files "../meshes";`: files and folders that are copied to the host together with a component.

In: the paths as written. Out: absolute paths, and diagnostics.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.syntax.ast.base import Text


def copied_files(written: Sequence[Text], beside: Path, report: Report) -> tuple[Path, ...]:
    """The absolute paths of existing files and folders, relative to the file `beside`."""
    paths = []
    for text in written:
        path = beside.parent / text.value
        if text.value and _is_readable(path):
            paths.append(Path(os.path.abspath(path)))  # noqa: PTH100 - keeps symbolic links
        else:
            _report_missing(text, path, beside, report)
    return tuple(dict.fromkeys(paths))


def _is_readable(path: Path) -> bool:
    try:
        return os.access(path, os.R_OK)
    except ValueError:  # a null character
        return False


def _report_missing(text: Text, path: Path, beside: Path, report: Report) -> None:
    try:
        known = sorted(entry.name for entry in os.scandir(path.parent))
    except (OSError, ValueError):
        known = []
    near = nearest(path.name, known) if text.value else None
    guess = (Path(text.value).parent / near).as_posix() if near else ""
    exists = bool(text.value) and os.path.lexists(path)
    message = f"cannot read `{path}`" if exists else f"cannot find `{path}`"
    report.add(
        codes.MISSING_FILE,
        text.span,
        message if text.value else "the path of a file or folder is empty",
        label=f"did you mean `{guess}`?" if guess and not exists else "",
        help=f"a path is relative to the folder of `{beside.name}`",
        fix=replace_fix(text.span, f'"{guess}"') if guess and not exists else None,
    )

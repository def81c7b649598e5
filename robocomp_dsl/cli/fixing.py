"""What `rcgen check --fix` does to one file.

In: a path and how it is judged. Out: the file rewritten whole, or the difference on standard
output; a line on standard error says what was fixed.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.fixes import Fixed, fix_all
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli.rewriting import difference, rewrite
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source, UnreadableSource

Judge = Callable[[Path, Workspace, Report], object]


def fix(path: Path, judge: Judge, workspace: Workspace, *, diff: bool) -> None:
    """Fix the file at `path`; with `diff` only show it. Raises `CannotWrite`.

    A file that cannot be read is left to the check, which says so.
    """
    try:
        before = workspace.files.read(path)
    except UnreadableSource:
        return
    try:
        fixed = fix_all(before, lambda text: _judged(path, text, judge, workspace))
    finally:
        workspace.files.close_buffer(path)
    if fixed.text == before.text:
        return
    if diff:
        sys.stdout.write(difference(path, before.text, fixed.text))
        return
    rewrite(path, fixed.text)
    print(_told(path, fixed), file=sys.stderr)


def _judged(
    path: Path, text: str, judge: Judge, workspace: Workspace
) -> tuple[Source, list[Diagnostic]]:
    source = workspace.files.open_buffer(path, text)
    report = Report()
    judge(path, workspace, report)
    return source, report.sorted()


def _told(path: Path, fixed: Fixed) -> str:
    """`arm.cdsl: fixed 3 (2 x RC130, RC142)`."""
    from robocomp_dsl.cli.render import shown_path  # noqa: PLC0415 - most runs fix nothing

    counts = Counter(one.code.id for one in fixed.applied)
    codes = ", ".join(f"{n} x {code}" if n > 1 else code for code, n in sorted(counts.items()))
    return f"{shown_path(path)}: fixed {len(fixed.applied)} ({codes})"

"""Applies the fixes of `rcgen check --fix` to one file.

In: a path and its check. Out: the rewritten file, or the difference on standard output; a line on
standard error says what was fixed.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.fixes import FixResult, fix_all
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.rewrite_file import rewrite_file, unified_diff
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source, UnreadableSource

Check = Callable[[Path, Workspace, Report], object]


def apply_fixes(path: Path, check: Check, workspace: Workspace, *, diff: bool) -> None:
    """Fix the file at `path`; with `diff` only show the changes. Raises `CannotWrite`.

    The check reports a file that cannot be read.
    """
    try:
        before = workspace.sources.read(path)
    except UnreadableSource:
        return
    try:
        fixed = fix_all(before, lambda text: _check_text(path, text, check, workspace))
    finally:
        workspace.sources.remove_overlay(path)
    if fixed.text == before.text:
        return
    if diff:
        sys.stdout.write(unified_diff(path, before.text, fixed.text))
        return
    rewrite_file(path, fixed.text)
    print(_summary(path, fixed), file=sys.stderr)


def _check_text(
    path: Path, text: str, check: Check, workspace: Workspace
) -> tuple[Source, list[Diagnostic]]:
    source = workspace.sources.set_overlay(path, text)
    report = Report()
    check(path, workspace, report)
    return source, report.sorted()


def _summary(path: Path, fixed: FixResult) -> str:
    """`arm.cdsl: fixed 3 (2 x RC130, RC142)`."""
    from robocomp_dsl.cli.output.render import display_path  # noqa: PLC0415 - most runs fix nothing

    counts = Counter(finding.code.id for finding in fixed.applied)
    codes = ", ".join(f"{n} x {code}" if n > 1 else code for code, n in sorted(counts.items()))
    return f"{display_path(path)}: fixed {len(fixed.applied)} ({codes})"

"""Applies safe fixes to a text.

In: a source and diagnostics. Out: the new text and the diagnostics that were fixed; no file is
written. Fixes of warnings and notes are safe: they keep the meaning and update the syntax. The fix
of an error is a guess, which the user has to confirm.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.diagnostics import Diagnostic, Edit, Severity
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source

MAX_ROUNDS = 20
"""A fix may reveal or overlap another one, so a text is checked again up to this often."""

_CHANGES_INTERFACE = (codes.EXCEPTION_WITHOUT_REPLY,)

Change = tuple[int, int, str]
"""Replace the range [start, end) by the text."""


class FixResult(ValueRecord):
    """A text after its fixes, the fixed diagnostics and the remaining ones."""

    text: str
    applied: tuple[Diagnostic, ...]
    remaining: tuple[Diagnostic, ...]


def is_safe(diagnostic: Diagnostic, source: Source) -> bool:
    """Whether the fix may be applied to `source` without confirmation."""
    return (
        diagnostic.fix is not None
        and diagnostic.severity is not Severity.ERROR
        and diagnostic.code not in _CHANGES_INTERFACE
        and all(edit.span.source is source for edit in diagnostic.fix.edits)
    )


def fix_all(source: Source, check: Callable[[str], tuple[Source, list[Diagnostic]]]) -> FixResult:
    """Apply all safe fixes to the text of `source`.

    `judge` returns the diagnostics of a text and its source. A round that would
    cause more errors is discarded.
    """
    text = source.text
    applied: tuple[Diagnostic, ...] = ()
    judged, found = check(text)
    for _ in range(MAX_ROUNDS):
        changed, done = apply_safe_fixes(judged, found)
        if not done or changed == text:
            break
        next_judged, next_found = check(changed)
        if _errors(next_found) > _errors(found):
            break
        text, judged, found = changed, next_judged, next_found
        applied += done
    return FixResult(text, applied, tuple(found))


def apply_safe_fixes(
    source: Source, findings: Iterable[Diagnostic]
) -> tuple[str, tuple[Diagnostic, ...]]:
    """One round: apply the safe fixes that do not overlap, in order.

    A fix is skipped if it would delete the text of an error.
    """
    findings = list(findings)
    wrong = [diagnostic.span for diagnostic in findings if diagnostic.severity is Severity.ERROR]
    broken = [
        (diagnostic.start, diagnostic.end, "")
        for diagnostic in wrong
        if diagnostic.source is source
    ]
    taken: list[Change] = []
    done: list[Diagnostic] = []
    for diagnostic in findings:
        if diagnostic.fix is None or not is_safe(diagnostic, source):
            continue
        changes = [_change(source, edit) for edit in diagnostic.fix.edits]
        if any(_covers(a, b) for a in changes for b in broken):
            continue
        if not any(_collide(a, b) for a in changes for b in taken):
            taken += changes
            done.append(diagnostic)
    text = source.text
    for start, end, new in sorted(taken, reverse=True):
        text = text[:start] + new + text[end:]
    return text, tuple(done)


def _errors(findings: Iterable[Diagnostic]) -> int:
    return sum(diagnostic.severity is Severity.ERROR for diagnostic in findings)


def _collide(diagnostic: Change, other: Change) -> bool:
    return diagnostic[0] == other[0] or max(diagnostic[0], other[0]) < min(diagnostic[1], other[1])


def _covers(change: Change, wrong: Change) -> bool:
    return change[0] < wrong[1] and wrong[0] < change[1]


def _change(source: Source, edit: Edit) -> Change:
    """The edit with the line ends of the file; a line that would become empty is deleted."""
    text, start, end = source.text, edit.span.start, edit.span.end
    if edit.text:
        new = edit.text.replace("\r\n", "\n")
        return start, end, new.replace("\n", "\r\n") if "\r\n" in text else new
    first = text.rfind("\n", 0, start) + 1
    last = text.find("\n", end) + 1 or len(text)
    if start < end and not text[first:start].strip() and not text[end:last].strip():
        return first, last, ""
    return start, end, ""

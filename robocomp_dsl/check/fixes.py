"""Automatic fixes: from the findings about a text to the text without them.

In: a source and findings. Out: the new text and the findings whose fixes are in it; nothing is
written. A fix is automatic when its finding is a warning or a note: such a text is understood
already, and the fix says the same in today's form. What would cure an error is a guess at what
was meant, which is the user's to take.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Diagnostic, Edit, Severity
from robocomp_dsl.record import Value
from robocomp_dsl.source import Source

ROUNDS = 20
"""A fix may uncover or collide with another one, so a text is judged again this often at most."""

_CHANGES_INTERFACE = (codes.UNHEARD_EXCEPTION,)

Change = tuple[int, int, str]
"""Put the text in the place [start, end)."""


class Fixed(Value):
    """A text after its fixes: what was fixed, and what is still found in it."""

    text: str
    applied: tuple[Diagnostic, ...]
    remaining: tuple[Diagnostic, ...]


def is_automatic(one: Diagnostic, source: Source) -> bool:
    """Whether the fix of a finding may be applied to `source` without asking."""
    return (
        one.fix is not None
        and one.severity is not Severity.ERROR
        and one.code not in _CHANGES_INTERFACE
        and all(edit.span.source is source for edit in one.fix.edits)
    )


def fix_all(source: Source, judge: Callable[[str], tuple[Source, list[Diagnostic]]]) -> Fixed:
    """The text of `source` with all automatic fixes.

    `judge` gives the findings about a text and the source that they point into. A round that would
    lead to more errors is not taken.
    """
    text = source.text
    applied: tuple[Diagnostic, ...] = ()
    judged, found = judge(text)
    for _ in range(ROUNDS):
        changed, done = apply(judged, found)
        if not done or changed == text:
            break
        next_judged, next_found = judge(changed)
        if _errors(next_found) > _errors(found):
            break
        text, judged, found = changed, next_judged, next_found
        applied += done
    return Fixed(text, applied, tuple(found))


def apply(source: Source, findings: Iterable[Diagnostic]) -> tuple[str, tuple[Diagnostic, ...]]:
    """One round: the automatic fixes that do not collide, first come first served.

    A fix never takes away what an error is about: the user has still to say what it means.
    """
    findings = list(findings)
    wrong = [one.span for one in findings if one.severity is Severity.ERROR]
    broken = [(one.start, one.end, "") for one in wrong if one.source is source]
    taken: list[Change] = []
    done: list[Diagnostic] = []
    for one in findings:
        if one.fix is None or not is_automatic(one, source):
            continue
        changes = [_change(source, edit) for edit in one.fix.edits]
        if any(_covers(a, b) for a in changes for b in broken):
            continue
        if not any(_collide(a, b) for a in changes for b in taken):
            taken += changes
            done.append(one)
    text = source.text
    for start, end, new in sorted(taken, reverse=True):
        text = text[:start] + new + text[end:]
    return text, tuple(done)


def _errors(findings: Iterable[Diagnostic]) -> int:
    return sum(one.severity is Severity.ERROR for one in findings)


def _collide(one: Change, other: Change) -> bool:
    return one[0] == other[0] or max(one[0], other[0]) < min(one[1], other[1])


def _covers(change: Change, wrong: Change) -> bool:
    return change[0] < wrong[1] and wrong[0] < change[1]


def _change(source: Source, edit: Edit) -> Change:
    """The edit with the line ends of the file; a line of which nothing would be left goes whole."""
    text, start, end = source.text, edit.span.start, edit.span.end
    if edit.text:
        new = edit.text.replace("\r\n", "\n")
        return start, end, new.replace("\n", "\r\n") if "\r\n" in text else new
    first = text.rfind("\n", 0, start) + 1
    last = text.find("\n", end) + 1 or len(text)
    if start < end and not text[first:start].strip() and not text[end:last].strip():
        return first, last, ""
    return start, end, ""

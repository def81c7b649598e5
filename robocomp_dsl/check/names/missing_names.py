"""Finds the name that a declaration without a name should have: one that is used, but not declared.

In: the findings of a file, and a function that checks another text of it. Out: the findings, with
the name and its uses at the syntax error, and without what disappears when the name is inserted.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix, Note, Report, Severity
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.codes import legacy, syntax

Recheck = Callable[[Source], Report | None]
"""What is found in another text of the file; None if that text has syntax errors."""

_ENDS = re.compile(r"[\s;,:)>\].]|\Z")
"""What follows a name without a blank."""

MAX_NAMES = 3
"""Number of unknown names that are tried."""

MAX_PLACES = 2
"""Number of syntax errors at which a name is inserted; after more, the text is too uncertain."""

MAX_LENGTH = 10_000
"""Length of a text from which nothing is tried: each try is a check of the file."""

_PLACES = (syntax.UNEXPECTED.id, syntax.MISSING_PUNCTUATION.id, legacy.TRAILING_COMMA.id)


def report_missing_name(report: Report, file: Parsed[Any], recheck: Recheck) -> bool:
    """If a name makes a file correct where its syntax is not, offer to insert it.

    Returns whether it does. Then no finding that remains follows from the syntax error.
    """
    uses: dict[str, list[Diagnostic]] = {}
    for found in report:
        if found.unknown and found.span.source is file.source:
            uses.setdefault(found.unknown.text, []).append(found)
    places = [found for found in file.diagnostics if found.code.id in _PLACES]
    if not uses or len(places) > MAX_PLACES or len(file.source.text) > MAX_LENGTH:
        return False
    for place in places:
        for edit, name in _insertions(place, uses):
            rest = recheck(_edited(file.source, edit))
            if rest is not None and _explains(name, rest, report):
                _report(place, Fix(f"add `{name}`", (edit,)), uses[name], rest, report)
                return True
    return False


def _insertions(
    place: Diagnostic, uses: Mapping[str, Sequence[Diagnostic]]
) -> Iterator[tuple[Edit, str]]:
    """The edits that insert an unknown name at a syntax error, the most frequent name first."""
    span, text = place.span, place.span.source.text
    offsets = dict.fromkeys((_end_before(span.start, text), span.start, span.end, *_unit(place)))
    for name in sorted(uses, key=lambda name: -len(uses[name]))[:MAX_NAMES]:
        for at in offsets:
            before = " " if text[at - 1 : at].strip() else ""
            behind = "" if _ENDS.match(text, at) else " "
            yield Edit(span.subspan(at, at), f"{before}{name}{behind}"), name


def _unit(place: Diagnostic) -> Iterator[int]:
    """Before the unit that precedes a syntax error: the name precedes it, as in `x [m]`."""
    text = place.span.source.text
    end = _end_before(place.span.start, text)
    if text[end - 1 : end] == "]":
        yield _end_before(text.rfind("[", 0, end), text)


def _end_before(offset: int, text: str) -> int:
    """The end of the token before `offset`."""
    return len(text[:offset].rstrip())


def _edited(source: Source, edit: Edit) -> Source:
    text, span = source.text, edit.span
    return Source(source.path, text[: span.start] + edit.text + text[span.end :])


def _explains(name: str, rest: Report, report: Report) -> bool:
    """Whether a text with findings `rest` has fewer errors, none of them new or about `name`."""
    errors = _errors(rest)
    is_known = not any(found.unknown and found.unknown.text == name for found in rest)
    return is_known and errors < _errors(report)


def _errors(report: Report) -> set[tuple[str, str]]:
    return {_key(found) for found in report if found.severity is Severity.ERROR}


def _key(found: Diagnostic) -> tuple[str, str]:
    return found.code.id, found.message


def _report(
    place: Diagnostic, fix: Fix, uses: Sequence[Diagnostic], rest: Report, report: Report
) -> None:
    """Report the missing name at `place`, and nothing that is not in `rest`."""
    assert uses[0].unknown  # noqa: S101 - the caller selected such findings
    name = uses[0].unknown.text
    notes = tuple(Note(use.span, f"`{name}` is used here") for use in uses)
    remaining = {_key(found) for found in rest}
    gone = [d for d in report if d.span.source is place.span.source and _key(d) not in remaining]
    is_named = place.uncertain is not None and place.uncertain.declares
    moved = place.replace(
        code=place.code if place.severity is Severity.ERROR else uses[0].code,
        message=place.message if is_named else f"a name is missing: `{name}` is not declared",
        label=f"did you mean `{name}`?",
        notes=notes,
        help="",
        fix=fix,
    )
    report.replace([*gone, place], moved)

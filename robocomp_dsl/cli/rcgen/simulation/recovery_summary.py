"""Summarises how errors in a world were repaired for its simulation.

In: the findings of a body. Out: one line with the counts of repairs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robocomp_dsl.check.codes import innermodel as codes
from robocomp_dsl.diagnostics import Code, Diagnostic, Severity

_DONE = {
    codes.INNERMODEL_DUPLICATE_ID: ("node", "renamed"),
    codes.INNERMODEL_VALUE: ("value", "replaced by the default"),
    codes.INNERMODEL_ATTRIBUTE: ("attribute", "left out or taken as another"),
    codes.INNERMODEL_TAG: ("tag", "left out"),
    codes.INNERMODEL_NESTING: ("tag", "left out"),
    codes.INNERMODEL_TOO_LARGE: ("body", "cut off"),
    codes.INNERMODEL_INCLUDE: ("file", "not included"),
    codes.INNERMODEL_RULE: ("node", "simplified"),
    codes.INNERMODEL_TOUCH: ("touch sensor", "left out"),
}
_FORM = ("place", "repaired in its XML")
"""All syntax errors."""

_SKIN = ("place of skin", "simplified")
_SKIN_CODES = "RC82"


def summarise_recovery(findings: Iterable[Diagnostic]) -> str:
    """`2 nodes renamed, 1 tag left out`; only errors are counted."""
    counts = Counter(
        _done(finding.code) for finding in findings if finding.severity is Severity.ERROR
    )
    return ", ".join(_counted(count, *done) for done, count in counts.items())


def _done(code: Code) -> tuple[str, str]:
    usual = _SKIN if code.id.startswith(_SKIN_CODES) else _FORM
    return _DONE.get(code, usual)


def _counted(count: int, what: str, done: str) -> str:
    """`2 places of skin simplified`."""
    noun, *rest = what.split(" ", 1)
    return " ".join((str(count), noun + ("s" if count > 1 else ""), *rest, done))

"""Reports changes as findings.

In: a code, the old and the new declaration, and a message. Out: a finding at the new location with
a note at the old location; a removed declaration is reported at its old location.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.diagnostics import Code, Note, Report
from robocomp_dsl.source import Span


class Placed(Protocol):
    """Anything with a source location."""

    @property
    def span(self) -> Span:
        """The declaration's location."""
        ...


@dataclass(frozen=True, slots=True)
class Changes:
    """Adds findings about changes to a report."""

    report: Report

    def add(self, code: Code, old: Placed, new: Placed | None, message: str) -> None:
        """Report a change; `new` is None for a removed declaration, `old` for an added one."""
        place = new or old
        notes = [Note(old.span, "the old version")] if new and new is not old else []
        self.report.add(code, place.span, message, notes=notes)

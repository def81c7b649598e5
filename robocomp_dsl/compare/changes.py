"""How a change becomes a finding.

In: a code, what is new, what was, and words. Out: a finding at the new place with a note at the
old one; what is gone is found at its old place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.diagnostics import Code, Note, Report
from robocomp_dsl.source import Span


class Placed(Protocol):
    """Anything with a place."""

    @property
    def span(self) -> Span:
        """Where it is declared."""
        ...


@dataclass(frozen=True, slots=True)
class Changes:
    """Collects the findings."""

    report: Report

    def add(self, code: Code, old: Placed, new: Placed | None, said: str) -> None:
        """One change; `new` is None where the thing is gone, and `old` where it is all new."""
        place = new or old
        notes = [Note(old.span, "it was this")] if new and new is not old else []
        self.report.add(code, place.span, said, notes=notes)

"""The findings of one file, kept from growing without end.

In: what lexer, parser and builder find. Out: entries in the report of the run, at most `LIMIT`
errors and `LIMIT` warnings for a file, and a closing note where there were more.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import Code, Diagnostic, Edit, Fix, Note, Report, Severity
from robocomp_dsl.source import Piece, Source, Span
from robocomp_dsl.syntax import codes

LIMIT = 100


class Findings:
    """What was found in `source`; `errors` and `warnings` are counts.

    `cut` says that the rest of the file is not read, so that what is missing at the end is no news.
    `place` is what the spans of the tree are made in: `source`, or the piece of it that is read.
    """

    def __init__(self, source: Source, report: Report) -> None:
        self.source = source
        self.report = report
        self.errors = 0
        self.warnings = 0
        self.cut = False
        self.place: Source | Piece = source
        self._noted: set[str] = set()

    @property
    def crowded(self) -> bool:
        """Whether findings may have been left out, so that each depends on all the others."""
        return self.errors >= LIMIT or self.warnings >= LIMIT

    @property
    def full(self) -> bool:
        """Whether there are so many errors that reading on makes no sense."""
        return self.errors >= LIMIT

    def add(
        self,
        code: Code,
        start: int,
        end: int,
        message: str,
        *,
        label: str = "",
        notes: tuple[Note, ...] = (),
        help: str = "",
        fix: Fix | None = None,
    ) -> None:
        """Add a finding about the characters [start, end)."""
        span = self.source.span(start, end)
        # A finding stays with its text; what a note points at may move to the next one.
        notes = tuple(Note(self.source.span(n.span.start, n.span.end), n.message) for n in notes)
        if code.severity is Severity.ERROR:
            self.errors += 1
            if self.errors > LIMIT:
                self._close(span, "errors; the file is not read any further")
                return
        else:
            self.warnings += 1
            if self.warnings > LIMIT:
                self._close(span, "warnings; further ones in this file are not listed")
                return
        self.report.add(code, span, message, label=label, notes=notes, help=help, fix=fix)

    def again(self, found: Sequence[Diagnostic]) -> None:
        """Add findings that were made before, in a text that is still the same."""
        errors = sum(one.severity is Severity.ERROR for one in found)
        self.errors += errors
        self.warnings += len(found) - errors
        self.report.extend(found)

    def fix(self, title: str, *edits: tuple[int, int, str]) -> Fix:
        """A fix that puts texts in the places [start, end)."""
        return Fix(title, tuple(Edit(self.source.span(s, e), text) for s, e, text in edits))

    def _close(self, span: Span, what: str) -> None:
        if what not in self._noted:
            self._noted.add(what)
            self.report.add(codes.TOO_MANY, span, f"more than {LIMIT} {what}")

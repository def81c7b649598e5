"""The syntax diagnostics of one file, limited in number.

In: diagnostics of the lexer, parser and builder. Out: entries in the report of the run, at most
`LIMIT` errors and `LIMIT` warnings per file, and one warning if there were more.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import (
    Code,
    Diagnostic,
    Edit,
    Fix,
    Note,
    Report,
    Severity,
    UncertainText,
)
from robocomp_dsl.source import Source, Span, TextRegion
from robocomp_dsl.syntax.codes import file as codes

LIMIT = 100


class FileDiagnostics:
    """The diagnostics of `source`; `errors` and `warnings` are counts.

    `is_truncated`: the rest of the file is skipped, so missing tokens at the end are not reported.
    `depends_from`: an error depends on the text from there on, although it was parsed before.
    `region` is the owner of the spans in the tree: `source`, or the region that is being parsed.
    """

    def __init__(self, source: Source, report: Report) -> None:
        self.source = source
        self.report = report
        self.errors = 0
        self.warnings = 0
        self.is_truncated = False
        self.depends_from: int | None = None
        self.region: Source | TextRegion = source
        self._noted: set[str] = set()

    @property
    def limit_reached(self) -> bool:
        """Whether diagnostics may have been dropped, so that each depends on all the others."""
        return self.errors >= LIMIT or self.warnings >= LIMIT

    @property
    def count_before_limit(self) -> int:
        """How many diagnostics of any kind can follow before `limit_reached`."""
        return LIMIT - 1 - max(self.errors, self.warnings)

    @property
    def is_closed(self) -> bool:
        """Whether the diagnostic about the skipped rest of the file has been added."""
        return self.errors > LIMIT

    @property
    def too_many_errors(self) -> bool:
        """Whether the rest of the file is skipped because of its errors."""
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
        uncertain: UncertainText | None = None,
    ) -> None:
        """Add a diagnostic about the characters [start, end)."""
        span = self.source.span(start, end)
        # The spans of a node may move to the next version of the text; those of a note must not.
        notes = tuple(Note(self.source.span(n.span.start, n.span.end), n.message) for n in notes)
        if code.severity is Severity.ERROR:
            self.errors += 1
            if self.errors > LIMIT:
                self._close(span, "errors; the rest of the file is skipped")
                return
        else:
            self.warnings += 1
            if self.warnings > LIMIT:
                self._close(span, "warnings; further warnings of this file are not listed")
                return
        self.report.add(
            code, span, message, label=label, notes=notes, help=help, fix=fix, uncertain=uncertain
        )

    def replay(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Add diagnostics of an earlier version about unchanged text."""
        errors = sum(diagnostic.severity is Severity.ERROR for diagnostic in diagnostics)
        self.errors += errors
        self.warnings += len(diagnostics) - errors
        self.report.extend(diagnostics)

    def fix(self, title: str, *edits: tuple[int, int, str]) -> Fix:
        """A fix that replaces the ranges [start, end) by texts."""
        return Fix(title, tuple(Edit(self.source.span(s, e), text) for s, e, text in edits))

    def _close(self, span: Span, message: str) -> None:
        if message not in self._noted:
            self._noted.add(message)
            self.report.add(codes.TOO_MANY_FINDINGS, span, f"more than {LIMIT} {message}")

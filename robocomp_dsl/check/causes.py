"""Leaves one finding for each mistake: the one about its cause.

In: a parsed file and the report of its checks. Out: the report without findings that follow from
another one, and with errors about unknown names at the declaration that is misspelled or missing.
"""

from __future__ import annotations

from robocomp_dsl.check.follow_on import ParsedFile, discard_follow_on_errors
from robocomp_dsl.check.names.misspelled_declarations import report_misspelled_declarations
from robocomp_dsl.diagnostics import Report


def report_causes(report: Report, file: ParsedFile) -> None:
    """Replace findings about `file` that follow from another mistake."""
    report_misspelled_declarations(report)
    discard_follow_on_errors(report, file)

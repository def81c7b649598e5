"""Leaves one finding for each mistake: the one about its cause.

In: a parsed file, the report of its checks, and these checks. Out: the report without findings that
follow from another one, and with errors about unknown names at the declaration that is misspelled
or missing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from robocomp_dsl.check.follow_on import discard_follow_on_errors
from robocomp_dsl.check.names.misspelled_declarations import report_misspelled_declarations
from robocomp_dsl.check.workspace.source_cache import Parsed, Parser
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source

Tree = TypeVar("Tree")


def report_causes(
    report: Report,
    file: Parsed[Tree],
    parser: Parser[Tree],
    resolve: Callable[[Parsed[Tree], Report], object],
) -> None:
    """Replace findings about `file` that follow from another mistake.

    `resolve` are the checks whose findings `report` contains, beside those of `parser`.
    """
    if file.diagnostics and any(found.unknown for found in report):
        from robocomp_dsl.check.names.missing_names import report_missing_name  # noqa: PLC0415

        if report_missing_name(report, file, lambda source: _recheck(source, parser, resolve)):
            report_misspelled_declarations(report)
            return
    discard_follow_on_errors(report, file)
    report_misspelled_declarations(report)


def _recheck(
    source: Source, parser: Parser[Tree], resolve: Callable[[Parsed[Tree], Report], object]
) -> Report | None:
    report = Report()
    tree = parser(source, report)
    if report.has_errors:
        return None
    resolve(Parsed(source, tree, tuple(report)), report)
    return report

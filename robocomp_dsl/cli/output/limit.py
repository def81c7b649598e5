"""Limits the number of findings shown per file.

In: sorted findings. Out: the findings to show, and a line for each file that has more. Machine-
readable formats are always complete.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from robocomp_dsl.diagnostics import Diagnostic, Severity

MAX_FINDINGS = 100


def limit_findings(findings: Sequence[Diagnostic]) -> tuple[list[Diagnostic], list[str]]:
    """The findings to show, in order; if there are too many, errors take precedence."""
    of_file = Counter(_file(finding) for finding in findings)
    crowded = {path for path, count in of_file.items() if count > MAX_FINDINGS}
    if not crowded:
        return list(findings), []
    from robocomp_dsl.cli.output.render import strip_control_chars  # noqa: PLC0415 - most runs find little

    shown: Counter[str] = Counter()
    listed: set[int] = set()
    for finding in sorted(findings, key=lambda d: d.severity is not Severity.ERROR):
        path = _file(finding)
        if path not in crowded or shown[path] < MAX_FINDINGS:
            listed.add(id(finding))
            shown[path] += 1
    summaries = [
        f"{strip_control_chars(path)}: {of_file[path] - MAX_FINDINGS} further findings are not "
        "listed; --format json lists all"
        for path in crowded
    ]
    return [finding for finding in findings if id(finding) in listed], sorted(summaries)


def _file(finding: Diagnostic) -> str:
    return str(finding.span.source.path)

"""How many findings of a file are shown to people: the first ones, and how many there are more.

In: sorted findings. Out: those to show, and a line for each file that has more. What machines read
is always complete.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from robocomp_dsl.diagnostics import Diagnostic, Severity

MOST = 100


def listed(findings: Sequence[Diagnostic]) -> tuple[list[Diagnostic], list[str]]:
    """The findings to show, errors before others where there are too many, in their order."""
    of_file = Counter(_file(one) for one in findings)
    crowded = {path for path, count in of_file.items() if count > MOST}
    if not crowded:
        return list(findings), []
    from robocomp_dsl.cli.render import harmless  # noqa: PLC0415 - most runs find little

    shown: Counter[str] = Counter()
    kept: set[int] = set()
    for one in sorted(findings, key=lambda d: d.severity is not Severity.ERROR):
        path = _file(one)
        if path not in crowded or shown[path] < MOST:
            kept.add(id(one))
            shown[path] += 1
    told = [
        f"{harmless(path)}: {of_file[path] - MOST} further findings are not listed; "
        "--format json has all"
        for path in crowded
    ]
    return [one for one in findings if id(one) in kept], sorted(told)


def _file(one: Diagnostic) -> str:
    return str(one.span.source.path)

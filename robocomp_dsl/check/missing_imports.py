"""Whether a component can be generated in part: only imported files are missing.

In: the findings of a check. Out: an answer. What needs a missing file is left out; the rest is
complete.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import names
from robocomp_dsl.diagnostics import Report, Severity

_MISSING = (names.MISSING_IMPORT, names.MISSING_ROS_DEFINITION, names.UNREADABLE_IMPORT)


def lacks_imports_only(report: Report) -> bool:
    """Whether there are errors, and all of them are about files that cannot be imported."""
    errors = [finding for finding in report if finding.severity is Severity.ERROR]
    return bool(errors) and all(finding.code in _MISSING for finding in errors)

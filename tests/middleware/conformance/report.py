"""Writes which cases passed as JSON, for the table of the documentation.

In: the reports of a run. Out: for each middleware and feature the numbers of cases that passed and
failed, and why others were skipped.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

SUITE = "tests/middleware/conformance/"


class ConformanceReport:
    """A pytest plugin; with xdist, that of the controller collects the cases of all workers."""

    def __init__(self, path: str) -> None:
        self._path = Path(path)
        self._results: dict[str, dict[str, dict[str, list[str]]]] = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add a case."""
        found = dict(report.user_properties)
        if "middleware" not in found or (report.when != "call" and report.passed):
            return
        features = self._results.setdefault(found["middleware"], {})
        results = features.setdefault(found["feature"], {"passed": [], "failed": [], "skipped": []})
        case = report.nodeid.removeprefix(SUITE)
        if report.skipped:
            where = report.longrepr
            reason = where[2].removeprefix("Skipped: ") if isinstance(where, tuple) else str(where)
            results["skipped"].append(reason.partition(": ")[2])
        else:
            results[report.outcome].append(case)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write the file."""
        if hasattr(session.config, "workerinput"):
            return
        summary = {
            middleware: {
                feature: {
                    "passed": len(results["passed"]),
                    "failed": len(results["failed"]),
                    "skipped": sorted(set(results["skipped"])),
                }
                for feature, results in sorted(features.items())
            }
            for middleware, features in sorted(self._results.items())
        }
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._path.write_text(json.dumps(summary, indent=2) + "\n")

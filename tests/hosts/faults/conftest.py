"""Deployments under load for the tests of faults, and the figures that the tests record.

`record_property(name, value)` of pytest records a figure; the figures are printed at the end, and
written to the file that the environment variable FAULT_FIGURES names.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print the figures of all tests."""
    reports = terminalreporter.stats.get("passed", [])
    figures = {
        str(name): value
        for report in reports
        if "hosts/faults/" in report.nodeid
        for name, value in report.user_properties
    }
    if not figures:
        return
    terminalreporter.section("faults")
    for name, value in figures.items():
        terminalreporter.write_line(f"{name:<64} {value}")
    if path := os.environ.get("FAULT_FIGURES"):
        Path(path).write_text(json.dumps(figures, indent=1) + "\n", "utf-8")

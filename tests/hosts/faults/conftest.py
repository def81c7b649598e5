"""The hosts of the tests of faults, and the figures that the tests record.

All tests share two hosts and one deployment, whose environments are installed once; each module
deploys what it needs. `record_property(name, value)` of pytest records a figure. The figures are
printed at the end, and written to the file that the environment variable FAULT_FIGURES names.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.hosts.faults.loaded_app import LoadedApp, journals_of, make_loaded_app
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.namespaces import TestNetwork

DISK_BYTES = 2_000_000_000
"""The size of the home of `robot`."""


@pytest.fixture(scope="session")
def loaded_app(
    test_network: TestNetwork, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[LoadedApp]:
    """Components for the hosts `robot` and `base`; nothing is deployed yet."""
    hosts = Hosts(tmp_path_factory.mktemp("hosts"), test_network)
    try:
        hosts.start("robot", disk_bytes=DISK_BYTES)
        hosts.start("base")
        for host in hosts.by_name.values():
            journals_of(host).mkdir()
            os.chown(journals_of(host), host.uid, host.uid)
        yield make_loaded_app(tmp_path_factory.mktemp("deployment") / "app", hosts)
    finally:
        hosts.close()


@pytest.fixture
def app(loaded_app: LoadedApp, monkeypatch: pytest.MonkeyPatch) -> LoadedApp:
    """The same; this process is the operator's."""
    loaded_app.enter(monkeypatch)
    return loaded_app


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
        terminalreporter.write_line(f"{name:<72} {value}")
    if path := os.environ.get("FAULT_FIGURES"):
        Path(path).write_text(json.dumps(figures, indent=1) + "\n", "utf-8")

"""Runs the suite over every installed middleware that connects components.

`pytest tests/middleware/conformance --middleware NAME --deadline SECONDS` runs it for a
middleware, also of another distribution.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from robocomp_dsl.runtime.middleware.registry import capabilities_of
from tests.middleware.conformance import report
from tests.middleware.conformance.peer_launcher import Peer, PeerLauncher, launched
from tests.middleware.conformance.selection import missing_capability, tested_middlewares
from tests.middleware.network import Network

_DEADLINE_S = 120.0
_MARKERS = (
    "feature(name): the row of the conformance table to which a case belongs",
    "needs(*items): skip without these capabilities; an item of `QOS_ITEMS`, or a field",
)


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("conformance of middlewares")
    group.addoption(
        "--middleware",
        action="append",
        default=[],
        metavar="NAME",
        help="test this middleware instead of all that are installed; may be repeated",
    )
    group.addoption(
        "--deadline",
        type=float,
        default=_DEADLINE_S,
        metavar="SECONDS",
        help="a case that takes longer fails (default: %(default)s)",
    )
    group.addoption(
        "--conformance-report",
        metavar="FILE",
        help="write what passed to this JSON file, from which the documentation is generated",
    )


def pytest_configure(config: pytest.Config) -> None:
    for marker in _MARKERS:
        config.addinivalue_line("markers", marker)
    tested_middlewares(config.getoption("--middleware", default=[]))
    if path := config.getoption("--conformance-report", default=None):
        config.pluginmanager.register(report.ConformanceReport(path))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "middleware" in metafunc.fixturenames:
        chosen = metafunc.config.getoption("--middleware", default=[])
        metafunc.parametrize("middleware", tested_middlewares(chosen), scope="session")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Give every case of this suite the deadline, and its cell of the table."""
    deadline = config.getoption("--deadline", default=_DEADLINE_S)
    for item in items:
        if item.nodeid.startswith(report.SUITE):
            item.add_marker(pytest.mark.timeout(deadline))
            feature, callspec = item.get_closest_marker("feature"), getattr(item, "callspec", None)
            if feature and callspec and "middleware" in callspec.params:
                name = callspec.params["middleware"]
                item.user_properties += [("middleware", name), ("feature", feature.args[0])]


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip a case whose semantics the capabilities exclude."""
    callspec = getattr(item, "callspec", None)
    if callspec and "middleware" in callspec.params:
        name = callspec.params["middleware"]
        needed = [need for marker in item.iter_markers("needs") for need in marker.args]
        for need in needed:
            if reason := missing_capability(capabilities_of(name), need):
                pytest.skip(f"{name}: {reason}")


@pytest.fixture
def network(middleware: str) -> Iterator[Network]:
    """A domain on the middleware under test."""
    opened = Network(middleware)
    yield opened
    opened.close()


@pytest.fixture(scope="session")
def launcher() -> Iterator[PeerLauncher]:
    """Starts components in other processes."""
    with launched() as started:
        yield started


@pytest.fixture
def start_peer(network: Network, launcher: PeerLauncher) -> Iterator[Callable[..., Peer]]:
    """Starts a program of `peer_programs` on the middleware and in the domain of the test."""

    def start(program: str, **options: object) -> Peer:
        return launcher.start(program, network.middleware, network.domain, **options)

    yield start
    launcher.end_peers()

"""The conformance suite of middlewares, for zenoh between clients of a router with mutual TLS.

Its components have any names, so the rules let the certificate do everything; the rules themselves
are tested in `test_undeclared_use` and `test_legal_patterns`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robocomp_dsl.deploy.network.operator_settings import operator_settings
from robocomp_dsl.runtime.presence.network_settings import NETWORK_VARIABLE
from tests.deploy.network.secured_deployment import SecuredDeployment
from tests.deploy.rcdeploy_process import RunningProcess

ROOT = Path(__file__).parents[3]
SUITE = "tests/middleware/conformance"
FILES = ("test_queries", "test_publications", "test_latched", "test_qos", "test_prefixes")


def test_zenoh_over_router_passes_conformance_suite(
    site: SecuredDeployment, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = site.keys.path / "operator.json"
    settings.write_text(operator_settings(site.deployment, site.keys).to_json(site.keys.path))
    files = [f"{SUITE}/{name}.py" for name in FILES]
    options = ["-q", "-p", "no:cacheprovider", "--middleware", "zenoh"]
    with site.start_router(site.hosts[0]) as router:
        monkeypatch.setenv(NETWORK_VARIABLE, str(settings))
        command = [sys.executable, "-m", "pytest", *options, *files]
        with RunningProcess(*command, where=ROOT) as suite:
            assert suite.end() == 0, "\n".join(suite.lines)
        assert suite.has(" passed")
        router.process.terminate()
        assert router.end() == 0
    assert router.has("rcdeploy is connected"), "the suite has used the router"
    assert not router.has("denied")

"""A simulated fleet of 20 robots with 50 components each: checked, placed by load, planned, diffed.

In a process that has loaded the modules, with nothing kept from another round but the hashes of
files. The diff compares what each host should have with the report of a host on which one component
of 50 has another command line.
"""

from __future__ import annotations

import gc
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any, TypeVar

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.program import GC_GEN0_THRESHOLD
from robocomp_dsl.cli.rcdeploy.plan import as_text
from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.hosts.description import HostSettings, deployment_hosts, describe_hosts
from robocomp_dsl.deploy.hosts.host_report import HostReport, UnitState
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.hosts.rollout import all_changes
from robocomp_dsl.deploy.network.access_rules import access_rules
from robocomp_dsl.deploy.placement.host_load import HostLoad
from robocomp_dsl.deploy.placement.place import place
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.deploy.units.service import REVISION_VARIABLE, find_revision
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment
from tests.support.fleet import write_fleet

HOSTS, COMPONENTS = 20, 50
ROUNDS = 5
GOAL_S = 2.0
Result = TypeVar("Result")


class FleetRound:
    """One round; `times` are in s by step."""

    def __init__(self, app: Path, hashes: HashCache) -> None:
        self._app = app
        self._hashes = hashes
        self.times: dict[str, float] = {}

    def run(self) -> None:
        """All steps."""
        deployment = self._timed("check", self._check)
        loads = {host.name: HostLoad(1.0, 0.5, 0.2, 8) for host in deployment.hosts}
        result = self._timed("place by load", lambda: place(deployment, loads, {}))
        placed = result.deployment
        planned = self._timed(
            "plan", lambda: plan(placed, name="fleet", domain="fleet", interpreter="python3")
        )
        self._timed("print the plan", lambda: "\n".join(as_text(planned)))
        self._timed("access rules", lambda: access_rules(placed, "fleet"))
        described = self._timed("units", lambda: self._describe(placed, planned))
        reports = {name: _report(manifest) for name, manifest in described.items()}
        changes = self._timed("diff", lambda: all_changes(described, reports))
        assert [len(change.components) for change in changes] == [1] * HOSTS

    def _timed(self, name: str, work: Callable[[], Result]) -> Result:
        begin = time.perf_counter()
        result = work()
        self.times[name] = time.perf_counter() - begin
        return result

    def _check(self) -> Deployment:
        report = Report()
        workspace = Workspace([self._app.parent / "interfaces"], environ={})
        deployment = check_ddsl(self._app, workspace, report)
        assert deployment is not None
        assert not report.has_errors
        return deployment

    def _describe(self, deployment: Deployment, planned: Plan) -> Mapping[str, HostManifest]:
        report = Report()
        trees = describe_trees(deployment, planned, report, hashes=self._hashes)
        settings = {
            host.name: HostSettings("python3", "python3") for host in deployment_hosts(deployment)
        }
        return describe_hosts(deployment, planned, trees, settings, report)


def _report(manifest: HostManifest) -> HostReport:
    """A host that has the manifest, with another command line in its first component."""
    units = dict(manifest.units)
    unit = manifest.components[0].unit
    earlier = units[unit].replace("--log-format", "--log-style")
    units[unit] = earlier.replace(f"{REVISION_VARIABLE}=", f"{REVISION_VARIABLE}=earlier")
    states = {
        name: UnitState("loaded", "active", "running", revision=find_revision(text))
        for name, text in units.items()
    }
    stored = replace(manifest, units=units)
    return HostReport("1", (1,), stored.to_json(), units, states, 0.0)


def run() -> list[dict[str, Any]]:
    """The figures."""
    gc.set_threshold(GC_GEN0_THRESHOLD)
    rounds = []
    with tempfile.TemporaryDirectory() as folder:
        app = write_fleet(Path(folder), HOSTS, COMPONENTS, placed_by="by load")
        hashes = HashCache(Path(folder) / "hashes")
        for _ in range(ROUNDS):
            rounds.append(FleetRound(app, hashes))
            rounds[-1].run()
    what = f"{HOSTS} hosts, {HOSTS * COMPONENTS} components"
    steps = {name: median(each.times[name] for each in rounds) for name in rounds[0].times}
    figures = [
        {"name": f"{what}: {name}", "value": value, "unit": "s"} for name, value in steps.items()
    ]
    total = median(sum(each.times.values()) for each in rounds)
    return [*figures, {"name": f"{what}: all", "value": total, "unit": "s", "goal": GOAL_S}]

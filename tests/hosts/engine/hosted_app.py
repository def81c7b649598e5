"""Deployments over simulated hosts, for tests of the engine."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest

from robocomp_dsl.cli.rcdeploy.app import check
from robocomp_dsl.deploy.checked_deployment import CheckedDeployment
from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.hosts.deployer import Deployer
from robocomp_dsl.deploy.hosts.differences import HostChanges
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_engine import HostEngine, run_async
from robocomp_dsl.deploy.hosts.host_logs import HostLogReader, LogRequest, read_past
from robocomp_dsl.deploy.hosts.rollout import RolloutResult
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.network.identities import identities
from robocomp_dsl.deploy.network.key_folder import key_folder
from robocomp_dsl.deploy.network.update_keys import update_keys
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.model.deployment import Host
from tests.deploy.generated_components import generate_components
from tests.hosts.rig.hosts import Hosts

ARM = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        self.log.info("arm begins")
    def Laser_getLaserData(self):
        return [TData(0.5, float(os.getpid()))]
"""
EYE = """
class SpecificWorker(GenericWorker):
    seen = 0
    def compute(self):
        pid = int(self.laser_proxy.getLaserData()[0].dist)
        if pid != self.seen:
            self.log.info("eye sees arm %d", pid)
        self.seen = pid
"""


class HostedApp:
    """`arm` on one host and `eye` on another, which starts after it."""

    def __init__(self, folder: Path, hosts: Hosts) -> None:
        self.folder = folder
        self.hosts = hosts
        self.lines: list[str] = []
        self.path = folder / "app.ddsl"

    def write(self, statements: str, name: str = "app") -> None:
        declared = "".join(
            f'    host {host} {{ address "{h.address}"; user {h.user}; }};\n'
            for host, h in self.hosts.by_name.items()
        )
        imports = 'import "arm/arm.cdsl";\nimport "eye/eye.cdsl";\n'
        self.path.write_text(f"{imports}Deployment {name}\n{{\n{declared}{statements}}};\n")

    def checked(self) -> CheckedDeployment:
        checked = check(self.path, [])
        assert checked.ready, [str(finding) for finding in checked.findings]
        return checked

    def deployer(self) -> Deployer:
        checked = self.checked()
        assert checked.plan
        assert checked.deployment
        return Deployer(checked.deployment, checked.plan, self.lines.append)

    def hosts_of_deployment(self) -> list[Host]:
        return [Host(name, h.address, h.user) for name, h in self.hosts.by_name.items()]

    def make_keys(self) -> None:
        """As `rcdeploy keys`."""
        deployment = self.checked().deployment
        assert deployment
        folder = key_folder(deployment.name)
        update_keys(deployment.name, identities(deployment), folder, datetime.now(UTC))

    def deploy(self, statements: str, name: str = "app") -> None:
        """Let the hosts run `statements`, whatever they ran before."""
        self.write(statements, name)
        self.make_keys()
        assert not self.up().failed, self.lines

    def up(self) -> RolloutResult:
        self.lines.clear()
        return run_async(self.deployer().up())

    def engine(self, name: str = "app") -> HostEngine:
        return HostEngine(next(e for e in registry.registered() if e.name == name))

    def enter(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Let this process be the operator's."""
        monkeypatch.setenv("HOME", str(self.hosts.operator))
        monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
        monkeypatch.setenv("XDG_STATE_HOME", str(self.hosts.operator / "state"))

    def diff(self) -> list[HostChanges]:
        return run_async(self.deployer().diff())

    def roll_back(self, version: int = 0) -> RolloutResult:
        self.lines.clear()
        return self.engine().roll_back(version, self.lines.append)

    def logs(self) -> list[LogRecord]:
        entry = self.engine().deployment
        readers = [HostLogReader(host, entry.name, LogRequest()) for host in entry.hosts]
        errors: list[HostError] = []
        records = run_async(read_past(readers, errors.append))
        assert not errors, errors
        return records

    def rows(self) -> dict[str, ProcessStatus]:
        return {row.name: row for row in self.engine().status().rows}

    def pids(self) -> dict[str, int]:
        return {name: row.pid for name, row in self.rows().items()}


def make_app(folder: Path, hosts: Hosts, eye: str = EYE) -> HostedApp:
    """Generate the components in `folder`; `eye` is the body of its worker."""
    folder.mkdir()
    generate_components(folder, {"arm": ARM, "eye": eye})
    hosts.trust()
    return HostedApp(folder, hosts)

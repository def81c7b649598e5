"""Trees and environments on simulated hosts without internet: real OpenSSH, real uv."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from tests.deploy.content.workspace_files import ROOT, check, write_component
from tests.hosts.content.deployed_content import DeployedContent
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost

APP = 'import "arm/arm.cdsl";\nDeployment app { component arm; };\n'
MAIN = "import numpy, zenoh, yaml\nimport robocomp_dsl.runtime\nprint('ready', numpy.zeros(3))\n"
DISK_BYTES = 1_000_000_000
ARM_FILES = {"main.py": MAIN, "etc/config.yaml": "rate: 20\n"}


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    """A host with a Python and nothing else of this project."""
    host = module_hosts.start("robot", checkout=False, disk_bytes=DISK_BYTES)
    module_hosts.trust()
    return host


@pytest.fixture(autouse=True)
def caches(operator: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The operator's home, with wheels in a cache that all tests of the machine share."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(operator.parent / "cache"))


class Deployed(DeployedContent):
    """A deployment of `arm` to a host."""

    def __init__(self, robot: SimulatedHost, folder: Path, **files: str) -> None:
        write_component(folder, "arm", {**ARM_FILES, **files})
        super().__init__(robot, *check(folder / "app.ddsl", APP))

    def run(self) -> str:
        """The output of the component on the host."""
        tree = self.content.trees["arm"]
        python = f"{self.robot.home_path}/{self.content.python_of('arm')}"
        folder = f"{self.robot.home_path}/{ROOT}/trees/{tree.hash}/{tree.working_folder}"
        return str(self.robot.run([python, f"{folder}/main.py"]).stdout)


@pytest.fixture
def app(robot: SimulatedHost, tmp_path: Path) -> Deployed:
    return Deployed(robot, tmp_path)


def environment_folder(app: Deployed) -> Path:
    """The folder with the environments of the host, as this process sees it."""
    return Path(app.robot.home, ROOT, "environments")


def test_host_content_is_copied_once_without_internet(app: Deployed, tmp_path: Path) -> None:
    first = app.up()
    assert first.trees == 1
    assert first.bytes > 20_000_000
    assert app.run().startswith("ready [0. 0. 0.]")
    assert app.check().is_complete
    (tmp_path / "arm/etc/config.yaml").write_text("rate: 21\n")
    changed = app.up()
    assert (changed.files, changed.bytes, changed.trees) == (1, len("rate: 21\n"), 1)
    assert app.run().startswith("ready")


def test_host_content_repairs_damaged_environment(app: Deployed) -> None:
    app.up()
    name = app.content.environment_of("arm").hash
    environment = environment_folder(app) / name
    marker = environment / "robocomp.json"
    content = marker.read_text()
    marker.unlink()  # as after a copy by hand
    assert app.check().damaged == {name: "incomplete"}
    marker.write_text(content)
    assert app.check().is_complete
    (module,) = environment.glob("lib/python*/site-packages/yaml/__init__.py")
    module.unlink()
    check = app.check()
    assert not check.is_complete
    assert check.damaged == {name: f"{module.relative_to(environment)} is missing"}
    assert app.up().bytes == 0  # the wheels are still there
    assert app.run().startswith("ready")
    assert app.check().is_complete


def test_host_content_needs_space(robot: SimulatedHost, tmp_path: Path) -> None:
    app = Deployed(robot, tmp_path, **{"requirements.txt": "Jinja2\n", "map.bin": "x" * 3_000_000})
    robot.limit_disk(40_000_000)
    try:
        app.check()
    finally:
        robot.limit_disk(DISK_BYTES)
    (finding,) = app.findings
    assert finding.code.id == "RC848"
    assert re.fullmatch(
        r"`robot`: not enough space: \d+ MB are needed, (39|40) MB are free", finding.message
    )
    assert re.fullmatch(
        r"\d+ MB to copy, \d MB of components, 1\d\d MB of Python packages", finding.label
    )


def test_host_content_shares_files_of_environments(robot: SimulatedHost, tmp_path: Path) -> None:
    """A second environment takes the space of what it has more."""
    Deployed(robot, tmp_path / "first").up()
    before = free_bytes(robot)
    second = Deployed(robot, tmp_path / "second", **{"requirements.txt": "MarkupSafe\n"})
    second.up()
    assert second.run().startswith("ready")
    assert before - free_bytes(robot) < 60_000_000  # bytecode, mostly
    installed = second.content.environment_of("arm")
    assert "markupsafe" in {locked.name for locked in installed.distributions}


def free_bytes(robot: SimulatedHost) -> int:
    status = os.statvfs(robot.home)
    return status.f_bavail * status.f_frsize


def test_host_content_names_packages_without_wheel(robot: SimulatedHost, tmp_path: Path) -> None:
    app = Deployed(robot, tmp_path, **{"requirements.txt": "no-such-package-at-all\n"})
    app.check()
    assert [finding.code.id for finding in app.findings] == ["RC846"]
    (finding,) = app.findings
    assert "`no-such-package-at-all` is not installed here" in finding.message

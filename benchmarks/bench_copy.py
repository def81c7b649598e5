"""Copies of the `wander` demo to an empty simulated host: OpenSSH, no internet, uv.

The demo has three components, of which one simulates a robot with MuJoCo. Needs what
`make test-hosts` installs; the network of the host is in a namespace of this machine.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.content.transfer import CopyResult
from tests.deploy.content.workspace_files import ROOT, check
from tests.hosts.content.deployed_content import DeployedContent
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.hosts.rig.namespaces import TestNetwork

COMPONENTS = Path(__file__).parents[1] / "components"
CHANGED = "wander/etc/config.yaml"


def run() -> list[dict[str, Any]]:
    """The figures."""
    network = TestNetwork()
    with tempfile.TemporaryDirectory() as folder:
        hosts = Hosts(Path(folder, "hosts"), network)
        try:
            robot = hosts.start("robot", checkout=False, disk_bytes=4_000_000_000)
            hosts.trust()
            os.environ |= {"HOME": str(hosts.operator), "XDG_CACHE_HOME": f"{folder}/cache"}
            os.environ.pop("SSH_AUTH_SOCK", None)
            return _measure(robot, Path(folder, "components"))
        finally:
            hosts.close()
            network.close()


def _measure(robot: SimulatedHost, components: Path) -> list[dict[str, Any]]:
    shutil.copytree(COMPONENTS, components)
    description = components / "wander" / "wander.ddsl"
    text = description.read_text()

    def deployed() -> DeployedContent:
        return DeployedContent(robot, *check(description, text))

    figures = _timed("wheels are made, once for each version", lambda: deployed().check())
    figures += _timed("first copy and installation", lambda: deployed().up())
    figures += _timed("nothing changed", lambda: deployed().up())
    with (components / CHANGED).open("a") as stream:
        stream.write("# changed\n")
    figures += _timed("one line of a file changed", lambda: deployed().up())
    app = deployed()
    app.check()
    for environment in app.content.all_environments:
        simulates = any(locked.name == "mujoco" for locked in environment.distributions)
        name = "environment with MuJoCo" if simulates else "environment"
        size = _size(Path(robot.home, ROOT, "environments", environment.hash))
        figures.append({"name": f"{name}, installed", "value": size / 1e6, "unit": "MB"})
    total = _size(Path(robot.home, ROOT))
    return [*figures, {"name": "all on the host", "value": total / 1e6, "unit": "MB"}]


def _timed(name: str, work: Any) -> list[dict[str, Any]]:
    begin = time.perf_counter()
    result = work()
    figures = [{"name": name, "value": time.perf_counter() - begin, "unit": "s"}]
    if isinstance(result, CopyResult):
        figures.append({"name": f"{name}: copied", "value": result.bytes / 1e6, "unit": "MB"})
        figures.append({"name": f"{name}: files", "value": result.files, "unit": ""})
    return figures


def _size(folder: Path) -> int:
    """Bytes below a folder; a file with several names counts once."""
    statuses = (path.lstat() for path in folder.rglob("*"))
    return sum({(s.st_dev, s.st_ino): s.st_blocks * 512 for s in statuses}.values())

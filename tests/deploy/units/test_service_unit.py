"""The unit of a component: what it says about readiness, restarts, limits and order."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.host_units import host_units
from robocomp_dsl.deploy.units.hosted_process import HostedProcess
from robocomp_dsl.deploy.units.router import HostedRouter, router_unit
from robocomp_dsl.deploy.units.service import find_revision, service_unit
from robocomp_dsl.model.deployment import Readiness, ResourceLimits, Restart
from tests.deploy.units.unit_samples import PYTHON, ROOT, hosted, settings


def unit(process: HostedProcess, *on_host: str) -> str:
    return service_unit(process, "patrol", frozenset(on_host))


def test_service_unit_of_component() -> None:
    text = unit(hosted(watchdog_s=2.0, env=(("MODE", "fast"),)))
    assert settings(text, "Type") == ["notify"]
    assert settings(text, "ExecStart") == [
        "%h/.local/share/robocomp/patrol/environments/e/bin/python main.py --name arm"
    ]
    assert settings(text, "WorkingDirectory") == ["%h/.local/share/robocomp/patrol/trees/t/arm"]
    assert settings(text, "WatchdogSec") == ["3"]
    assert settings(text, "StandardOutput") == [
        "append:%h/.local/share/robocomp/patrol/logs/arm.log"
    ]
    assert {"MODE=fast", "ROBOCOMP_HOST=robot"} <= set(settings(text, "Environment"))


def test_service_unit_waits_for_components_of_its_host() -> None:
    text = unit(hosted(after=("base", "eye"), network="/n.json"), "base")
    router = names.router_name("patrol")
    assert settings(text, "After") == [f"{router} {names.service_name('patrol', 'base')}"]
    assert settings(text, "Wants") == [router]
    assert not settings(unit(hosted(after=("eye",))), "After")


@pytest.mark.parametrize(
    ("restart", "policy", "burst"),
    [
        (Restart("never"), "no", []),
        (Restart("on-failure", 5, 60.0), "on-failure", ["6"]),
        (Restart("always", 2, 10.0), "always", ["3"]),
    ],
)
def test_service_unit_restarts(restart: Restart, policy: str, burst: list[str]) -> None:
    text = unit(hosted(restart=restart))
    assert settings(text, "Restart") == [policy]
    assert settings(text, "StartLimitBurst") == burst


@pytest.mark.parametrize(
    ("readiness", "command"),
    [
        (Readiness(delay_s=2.5), "/usr/bin/env sleep 2.5"),
        (Readiness(port=8080), "wait_until_ready port 8080"),
        (Readiness(pattern="up: [0-9]+$"), '"up: [0-9]+$$"'),
    ],
)
def test_service_unit_of_program_has_readiness(readiness: Readiness, command: str) -> None:
    text = unit(hosted(is_program=True, argv=("camera", "-v"), readiness=readiness))
    assert settings(text, "Type") == ["exec"]
    assert settings(text, "ExecStart") == ["/usr/bin/env camera -v"]
    [found] = settings(text, "ExecStartPost")
    assert found.endswith(command)


def test_service_unit_finds_program_in_its_folder() -> None:
    text = unit(hosted(argv=("./my camera",)))
    assert settings(text, "ExecStart") == [
        '"%h/.local/share/robocomp/patrol/trees/t/arm/my camera"'
    ]


def test_service_unit_limits_resources() -> None:
    limits = ResourceLimits(500_000_000, 0.8, (0, 2, 3), 40)
    text = unit(hosted(limits=limits))
    assert settings(text, "MemoryMax") == ["500000000"]
    assert settings(text, "CPUQuota") == ["80%"]
    assert settings(text, "CPUAffinity") == ["0 2 3"]
    assert settings(text, "CPUSchedulingPriority") == ["40"]


def test_service_unit_revision_follows_the_process() -> None:
    revision = find_revision(unit(hosted()))
    assert revision
    assert find_revision(unit(hosted(after=("base",)), "base")) == revision
    assert find_revision(unit(hosted(argv=(PYTHON, "other.py")))) != revision
    assert find_revision("") == ""


def test_host_units_watch_limits_without_controllers() -> None:
    processes = [hosted(limits=ResourceLimits(5, 0.5)), hosted("eye")]

    def units_with(*controllers: str) -> dict[str, str]:
        return host_units(processes, "patrol", root=ROOT, python=PYTHON, controllers=controllers)

    assert names.limits_name("patrol") not in units_with("cpu", "memory")
    [command] = settings(units_with("cpu")[names.limits_name("patrol")], "ExecStart")
    assert command.endswith("robocomp-patrol-arm.service arm 5 0")


def test_host_units_are_valid_for_systemd(tmp_path: Path) -> None:
    if shutil.which("systemd-analyze") is None:
        pytest.skip("systemd is not installed")
    process = hosted("left/arm-motor", after=("eye",), readiness=Readiness(pattern="a b$"))
    router = HostedRouter("router.robot", ROOT, PYTHON, f"{ROOT}/private/router.json", "1")
    units = host_units(
        [process, hosted("eye", limits=ResourceLimits(1, 1.0, (0,)), watchdog_s=1.0)],
        "patrol",
        root=ROOT,
        python=PYTHON,
        more=((names.router_name("patrol"), router_unit(router, "patrol")),),
        controllers=(),
    )
    folder = tmp_path / ".config/systemd/user"
    folder.mkdir(parents=True)
    root = tmp_path / ".local/share/robocomp/patrol"
    for program in ("environments/e/bin/python",):
        (root / program).parent.mkdir(parents=True)
        (root / program).write_text("#!/bin/sh\n")
        (root / program).chmod(0o755)
    for name, text in units.items():
        (folder / name).write_text(text)
    runtime = tmp_path / "run"
    runtime.mkdir(mode=0o700)
    environment = {**os.environ, "HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(runtime)}
    environment.pop("XDG_CONFIG_HOME", None)
    done = subprocess.run(
        ["systemd-analyze", "--user", "verify", *(str(folder / name) for name in units)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "robocomp" not in done.stderr, done.stderr

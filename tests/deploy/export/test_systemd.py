"""`systemd-analyze verify` accepts the units, and `install.sh` installs them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.deploy.export.conftest import Export

PYTHON = ".local/share/robocomp/Robot_1/environments/exported/bin/python"


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="systemd-analyze is not installed")
def test_systemd_units_are_valid(export: Export, tmp_path: Path) -> None:
    result = export("systemd")
    assert result.exit_code == 0, result.output
    python = tmp_path / PYTHON
    python.parent.mkdir(parents=True)
    python.symlink_to(sys.executable)
    runtime = tmp_path / "runtime"
    runtime.mkdir(mode=0o700)
    verified = subprocess.run(
        ["systemd-analyze", "--user", "verify", *map(str, units(tmp_path))],
        env={**os.environ, "HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(runtime)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (verified.returncode, verified.stderr) == (0, "")


def units(tmp_path: Path) -> list[Path]:
    return sorted((tmp_path / "build/localhost/units").iterdir())


def test_systemd_units_hold_settings(export: Export, tmp_path: Path) -> None:
    export("systemd")
    names = {path.name for path in units(tmp_path)}
    assert "robocomp-Robot_1-left-arm.service" in names
    assert "robocomp-Robot_1-left-head\\x2deye.service" in names
    text = (tmp_path / "build/localhost/units/robocomp-Robot_1-left-arm.service").read_text()
    assert "MemoryMax=200000000" in text
    assert "CPUAffinity=0 1" in text
    assert "$$HOME $${X} %%h" in text


def test_systemd_install_script_installs(export: Export, tmp_path: Path) -> None:
    """With a `python3` and a `systemctl` that only note how they were called."""
    export("systemd")
    home, programs, calls = tmp_path / "home", tmp_path / "bin", tmp_path / "calls"
    home.mkdir()
    programs.mkdir()
    for name in ("python3", "systemctl"):
        (programs / name).write_text(f'#!/bin/sh\necho {name} "$@" >> {calls}\n')
        (programs / name).chmod(0o755)
    pip = home / Path(PYTHON).with_name("pip")
    pip.parent.mkdir(parents=True)
    shutil.copy(programs / "systemctl", pip)
    environment = {"HOME": str(home), "PATH": f"{programs}:/usr/bin:/bin"}
    for _ in range(2):
        script = str(tmp_path / "build/localhost/install.sh")
        subprocess.run([script], env=environment, check=True, capture_output=True)
    root = home / ".local/share/robocomp/Robot_1"
    assert (root / "logs/left").is_dir()
    assert [p.name for p in units(tmp_path)] == sorted(
        p.name for p in (home / ".config/systemd/user").iterdir()
    )
    unit = (home / ".config/systemd/user/robocomp-Robot_1-left-arm.service").read_text()
    (folder,) = (x for x in unit.splitlines() if x.startswith("WorkingDirectory="))
    assert Path(folder.partition("=")[2].replace("%h", str(home))).joinpath("main.py").is_file()
    assert "systemctl --user restart robocomp-Robot_1.target" in calls.read_text()


def test_systemd_export_over_hosts_has_router_and_no_keys(export: Export, tmp_path: Path) -> None:
    path = tmp_path / "app.ddsl"
    path.write_text(path.read_text().replace("component arm\n", "component arm on brain\n"))
    result = export("systemd")
    assert result.exit_code == 0, result.output
    brain = tmp_path / "build/brain"
    assert (brain / "units/robocomp-Robot_1.router.service").is_file()
    assert (brain / "private/exported-router.json").is_file()
    assert (brain / "private/network-left%2Farm.json").is_file()
    assert '"$ROBOCOMP_KEYS"/left%2Farm.key' in (brain / "install.sh").read_text()
    assert not list((tmp_path / "build").rglob("*.key"))

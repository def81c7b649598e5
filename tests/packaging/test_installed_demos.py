"""The demos run from copied folders, with the package from a wheel.

`make test-wheel` runs these: each takes some 20 seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.packaging.installation import Installation

pytestmark = pytest.mark.wheel
LIMIT_S = 240.0
SLOW = "demo: the simulation did not keep up with the clock"


def _copy(installed: Installation, example: str, folder: Path) -> Path:
    """A copy of `example`, checked; its folder with `demo.py`."""
    copied = installed.run("rcgen", "new", "robot", "--example", example, cwd=folder)
    assert copied.returncode == 0, copied.stderr
    checked = installed.run("rcgen", "check", "robot", cwd=folder)
    assert (checked.returncode, checked.stdout) == (0, ""), checked.stderr
    (demo,) = folder.glob("robot/components/*/demo.py")
    return demo.parent


def test_installed_wander_demo(installed: Installation, tmp_path: Path) -> None:
    demo = _copy(installed, "wander", tmp_path)
    run = installed.run("python3", "demo.py", "--seconds", "3", cwd=demo, timeout=LIMIT_S)
    # A busy machine may simulate too slowly; all else must be in order.
    assert run.returncode == (SLOW in run.stderr), run.stdout + run.stderr
    assert (demo / "demo.png").read_bytes().startswith(b"\x89PNG")
    path = np.genfromtxt(tmp_path / "robot/build/wander/path.csv", delimiter=",", names=True)
    assert len(path) > 10


def test_installed_touch_demo(installed: Installation, tmp_path: Path) -> None:
    demo = _copy(installed, "touch", tmp_path)
    command = ("python3", "demo.py", "--robot", "nao", "--touches", "1")
    run = installed.run(*command, cwd=demo, timeout=LIMIT_S)
    assert run.returncode == 0, run.stdout + run.stderr
    assert (demo / "demo.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "robot/build/touch_demo/nao.npz").is_file()


def test_installed_rcdeploy_plan_of_a_copy(installed: Installation, tmp_path: Path) -> None:
    demo = _copy(installed, "touch", tmp_path)
    run = installed.run("rcdeploy", "nao.ddsl", "plan", cwd=demo)
    assert run.returncode == 0, run.stderr
    assert str(tmp_path / "robot" / "components" / "nao_simulator") in run.stdout
    assert str(installed.folder) in run.stdout

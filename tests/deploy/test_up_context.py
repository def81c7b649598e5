"""A deployment whose component searches for its configuration, installed, then the user's."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.deploy_process import Running, runtime_folder
from tests.deploy.deploy_robot import build

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"
ARM = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        print("arm begins with", self.params.serial, self.params.rate)
"""
APP = """
import "arm/arm.cdsl";
Deployment app
{
    component arm { context "lab"; ready within 200 s; };
};
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The deployment, a user without files, and an installed context."""
    monkeypatch.chdir(tmp_path)
    for name in ("CONFIG_HOME", "DATA_HOME", "CONFIG_DIRS", "DATA_DIRS"):
        monkeypatch.setenv(f"ROBOCOMP_{name}", str(tmp_path / name))
    build(tmp_path, {"arm": ARM})
    (tmp_path / "app.ddsl").write_text(APP)
    context = tmp_path / "DATA_DIRS" / "contexts" / "lab"
    context.mkdir(parents=True)
    (context / "arm.yaml").write_text("serial: installed\nrate: 30\n")
    with runtime_folder(monkeypatch):
        yield tmp_path


def test_live_values_are_kept_with_the_user_and_found_again(folder: Path) -> None:
    saved = folder / "DATA_HOME" / "contexts" / "lab" / "arm.saved.yaml"
    with Running(sys.executable, "-c", PROGRAM, "app.ddsl") as app:
        app.until("arm begins with installed 30.0", "arm is ready")
        change = [sys.executable, "-c", PROGRAM, "param", "set", "app", "arm", "rate=40", "--save"]
        result = subprocess.run(change, capture_output=True, text=True, check=False, timeout=60)
        assert result.stdout.splitlines()[-1] == f"kept in {saved}"
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    with Running(sys.executable, "-c", PROGRAM, "app.ddsl") as app:
        app.until("arm begins with installed 40.0", "arm is ready")
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0

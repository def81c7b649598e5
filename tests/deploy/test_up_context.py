"""A deployment whose component finds an installed configuration and saves live values."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.generated_components import generate_components
from tests.deploy.rcdeploy_process import rcdeploy, runtime_folder, start_rcdeploy

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
    generate_components(tmp_path, {"arm": ARM})
    (tmp_path / "app.ddsl").write_text(APP)
    context = tmp_path / "DATA_DIRS" / "contexts" / "lab"
    context.mkdir(parents=True)
    (context / "arm.yaml").write_text("serial: installed\nrate: 30\n")
    with runtime_folder(monkeypatch):
        yield tmp_path


def test_up_saves_live_values_in_user_folder_and_loads_them(folder: Path) -> None:
    saved = folder / "DATA_HOME" / "contexts" / "lab" / "arm.saved.yaml"
    with start_rcdeploy("app.ddsl") as app:
        app.until("arm begins with installed 30.0", "arm is ready")
        result = rcdeploy("param", "set", "app", "arm", "rate=40", "--save")
        assert result.stdout.splitlines()[-1] == f"kept in {saved}"
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    with start_rcdeploy("app.ddsl") as app:
        app.until("arm begins with installed 40.0", "arm is ready")
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0

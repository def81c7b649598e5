"""A deployment with everything that an export has to hold, and the command `rcdeploy export`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from robocomp_dsl.cli.rcdeploy.export import command
from tests.deploy.generated_components import generate_components

APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment Robot_1
{
    host brain { address "10.0.0.2"; labels gpu; };
    component arm
    {
        prefix left; config "arm.yaml"; set serial = "a $HOME ${X} %h 'quoted' /dev/ttyUSB0";
        env MODE = "fast $(MODE)"; env API_TOKEN = "t0ps3cret"; memory 200 MB; cpu 150 %;
        cores 0, 1; restart always max 3 in 10 s; watchdog 2 s;
    };
    group head
    {
        component eye { prefix left; after arm; restart never; };
        after arm;
    };
    program router
    {
        executable "python3 -m http.server 8000"; after arm; ready when port 8000 answers;
        restart on-failure max 2;
    };
    program note { executable "sleep 1000"; ready when log matches "up|ok$"; };
};
"""

Export = Callable[..., Result]


@pytest.fixture
def export(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Export:
    """Runs `rcdeploy export app.ddsl build --to TARGET …` in a folder with the deployment."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    generate_components(tmp_path)
    (tmp_path / "arm.yaml").write_text("rate: 20\n")
    (tmp_path / "app.ddsl").write_text(APP)

    def run(target: str, *arguments: str) -> Result:
        return CliRunner().invoke(command, ["app.ddsl", "build", "--to", target, *arguments])

    return run

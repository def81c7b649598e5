"""`rcdeploy up` with connections of one server over several middlewares."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

from robocomp_dsl.runtime.middleware.registry import BUILT_IN, description_of, missing_modules
from tests.deploy.generated_components import generate_components
from tests.deploy.laser_app import ARM
from tests.deploy.rcdeploy_process import runtime_folder, start_rcdeploy

EYE = """
class SpecificWorker(GenericWorker):
    def compute(self):
        self.laser_proxy.getLaserData()
        self.log.info("%s sees the arm", self.name)
        self.set_period(0)
"""


def usable_middlewares() -> list[str]:
    """The built-in middlewares that can connect client and server on this machine."""
    described = [description for name in BUILT_IN if (description := description_of(name))]
    return [
        item.name
        for item in described
        if item.capabilities.between_processes
        and item.capabilities.services
        and not item.capabilities.ros_types_only
        and not item.capabilities.valid_names
        and not missing_modules(item)
    ]


def test_server_is_called_over_every_usable_middleware(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = usable_middlewares()
    assert "zenoh" in names
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path, {"arm": ARM, "eye": EYE})
    clients = "".join(
        f"component eye_{name} : eye {{ after arm; ready within 200 s; }};\n"
        f"connect eye_{name}.Laser -> arm.Laser over {name};\n"
        for name in names
    )
    (tmp_path / "app.ddsl").write_text(
        'import "arm/arm.cdsl";\nimport "eye/eye.cdsl";\nDeployment app\n{\n'
        '    component arm { set serial = "abc"; ready within 200 s; };\n'
        f"{clients}}};\n"
    )
    with runtime_folder(monkeypatch), start_rcdeploy("app.ddsl") as running:
        running.until(*(f"eye_{name} sees the arm" for name in names))
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0

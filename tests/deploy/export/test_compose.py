"""The compose file is valid for compose's own schema and for podman-compose, and holds all."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.deploy.export.conftest import Export


def compose(tmp_path: Path) -> dict[str, Any]:
    data: dict[str, Any] = yaml.safe_load((tmp_path / "build/compose.yaml").read_text())
    return data


def test_compose_file_is_valid(export: Export, tmp_path: Path) -> None:
    """The schema of the compose specification, as `check-jsonschema` ships it."""
    assert export("compose").exit_code == 0
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec"]
    checked = subprocess.run(
        [*command, str(tmp_path / "build/compose.yaml")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert checked.returncode == 0, checked.stdout


def test_compose_values_survive_substitution(
    export: Export, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """podman-compose replaces variables and joins the services."""
    export("compose")
    podman = tmp_path / "podman"
    podman.write_text("#!/bin/sh\necho podman version 5.2.0\n")
    podman.chmod(0o755)
    monkeypatch.setenv("ROBOCOMP_KEYS", "/keys")
    monkeypatch.setenv("X", "wrong")
    read = subprocess.run(
        [sys.executable, "-m", "podman_compose", "--podman-path", str(podman), "config"],
        cwd=tmp_path / "build",
        capture_output=True,
        text=True,
        check=False,
    )
    assert read.returncode == 0, read.stderr
    services = yaml.safe_load(read.stdout)["services"]
    arm = services["left-arm"]
    assert "serial=a $HOME ${X} %h 'quoted' /dev/ttyUSB0" in arm["command"]
    assert arm["environment"]["MODE"] == "fast $(MODE)"
    secrets = yaml.safe_load(read.stdout)["secrets"]
    assert secrets["left-arm-private.key"] == {"file": "/keys/left%2Farm.key"}


def test_compose_services_hold_settings(export: Export, tmp_path: Path) -> None:
    export("compose")
    services = compose(tmp_path)["services"]
    # The name `router` belongs to the router of the network.
    (program,) = (name for name in services if name.startswith("router-"))
    assert set(services) == {"router", "left-arm", "left-head-eye", program, "note"}
    arm = services["left-arm"]
    assert (arm["mem_limit"], arm["cpus"], arm["cpuset"]) == (200_000_000, 1.5, "0,1")
    assert arm["restart"] == "always"
    assert arm["devices"] == ["/dev/ttyUSB0:/dev/ttyUSB0"]
    assert arm["network_mode"] == "service:router"
    assert arm["command"][3:6] == ["--watchdog", "2", "--cores"]
    (config,) = (each for each in arm["configs"] if each["source"] == "config-left-arm")
    assert config["target"].endswith("/arm.yaml")
    eye = services["left-head-eye"]
    assert eye["restart"] == "no"
    assert set(eye["depends_on"]) == {"router", "left-arm"}
    assert eye["depends_on"]["left-arm"] == {"condition": "service_healthy"}
    assert services[program]["restart"] == "on-failure:2"
    assert "--ready-port" in services[program]["command"]
    assert services["note"]["command"][3:5] == ["--ready-log", "up|ok$$"]


def test_compose_losses_are_findings(export: Export) -> None:
    output = export("compose", "--domain", "lab").output
    assert "RC861" in output
    assert "the program `sleep` of `note` is not in the image" in output
    assert "`in 10 s` of `arm` is not exported" in output
    assert "RC865" in output


def test_middleware_of_one_machine_is_refused(export: Export, tmp_path: Path) -> None:
    path = tmp_path / "app.ddsl"
    path.write_text(path.read_text().replace("{\n    host", "{\n    middleware local;\n    host"))
    for target in ("compose", "kubernetes"):
        refused = export(target)
        assert refused.exit_code == 1
        assert "RC863" in refused.output
    assert not (tmp_path / "build").exists()


def test_compose_router_denies_by_default(export: Export, tmp_path: Path) -> None:
    export("compose")
    router = json.loads((tmp_path / "build/network/router.json").read_text())
    assert router["listen"] == ["tls/127.0.0.1:7447"]
    assert router["access"]["default_permission"] == "deny"


def test_group_in_one_process_is_one_service(export: Export, tmp_path: Path) -> None:
    (tmp_path / "app.ddsl").write_text(
        'import "arm/arm.cdsl";\nimport "eye/eye.cdsl";\nDeployment Robot_1\n{\n'
        "    group body { inprocess; component arm { set serial = a; }; component eye { }; };\n};\n"
    )
    result = export("compose")
    assert result.exit_code == 0, result.output
    services = compose(tmp_path)["services"]
    assert set(services) == {"router", "body"}
    command = services["body"]["command"]
    assert "robocomp_dsl.runtime.group_process" in command
    folders = [command[i + 1] for i, word in enumerate(command) if word == "--component"]
    content = tmp_path / "build/content"
    assert len(folders) == 2
    assert all((content / folder.split("/content/")[1] / "main.py").is_file() for folder in folders)

"""The objects are valid for the API of Kubernetes, and hold the settings of the deployment."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.deploy.export.conftest import Export


def objects(tmp_path: Path) -> list[dict[str, Any]]:
    paths = sorted((tmp_path / "build/kubernetes").glob("*.yaml"))
    return [each for path in paths for each in yaml.safe_load_all(path.read_text())]


def pod(tmp_path: Path, name: str) -> dict[str, Any]:
    (found,) = (
        each["spec"]["template"]["spec"]
        for each in objects(tmp_path)
        if each["kind"] == "Deployment" and each["metadata"]["name"] == name
    )
    return dict(found)


def test_kubernetes_objects_are_valid(export: Export, tmp_path: Path) -> None:
    validator = pytest.importorskip("kubernetes_validate", reason="pip install kubernetes-validate")
    assert export("kubernetes").exit_code == 0
    checked = [each for each in objects(tmp_path) if each["kind"] != "Kustomization"]
    for each in checked:
        validator.validate(each, validator.latest_version(), strict=True)
    kinds = [each["kind"] for each in checked]
    assert (kinds.count("Deployment"), kinds.count("Namespace"), kinds.count("Service")) == (
        5,
        1,
        1,
    )
    with pytest.raises(validator.ValidationError):
        validator.validate({**checked[0], "metadata": 1}, validator.latest_version(), strict=True)


def test_kubernetes_pod_holds_settings(export: Export, tmp_path: Path) -> None:
    assert export("kubernetes").exit_code == 0
    deployments = [each for each in objects(tmp_path) if each["kind"] == "Deployment"]
    assert all(each["spec"]["strategy"] == {"type": "Recreate"} for each in deployments)
    (container,) = pod(tmp_path, "left-arm")["containers"]
    assert container["resources"]["limits"] == {"memory": "200000000", "cpu": "1500m"}
    variables = {each["name"]: each["value"] for each in container["env"]}
    assert variables["MODE"] == "fast $$(MODE)"
    assert "API_TOKEN" not in variables
    assert container["securityContext"] == {"privileged": True}
    assert {"name": "device-0", "mountPath": "/dev/ttyUSB0"} in container["volumeMounts"]
    (eye,) = pod(tmp_path, "left-head-eye")["containers"]
    assert eye["securityContext"]["allowPrivilegeEscalation"] is False
    assert eye["startupProbe"]["exec"]["command"] == ["test", "-e", "/run/robocomp/ready"]


def test_kubernetes_hosts_and_labels_select_nodes(export: Export, tmp_path: Path) -> None:
    path = tmp_path / "app.ddsl"
    text = path.read_text().replace("component eye {", "component eye on label gpu {")
    path.write_text(text.replace("component arm\n", "component arm on brain\n"))
    result = export("kubernetes")
    assert result.exit_code == 0, result.output
    assert pod(tmp_path, "left-arm")["nodeSelector"] == {"robocomp.dev/host": "brain"}
    assert pod(tmp_path, "left-head-eye")["nodeSelector"] == {"robocomp.dev/gpu": "true"}
    readme = (tmp_path / "build/README.md").read_text()
    assert "kubectl label node NODE robocomp.dev/gpu=true" in readme


def test_kubernetes_losses_are_findings(export: Export) -> None:
    output = export("kubernetes").output
    assert "`restart never` of `head-eye` is not exported" in output
    assert "RC866" in output


def test_secrets_script_reads_key_folder(export: Export, tmp_path: Path) -> None:
    """Run with a `kubectl` that prints its arguments."""
    export("kubernetes", "--keys")
    kubectl = tmp_path / "bin" / "kubectl"
    kubectl.parent.mkdir()
    kubectl.write_text('#!/bin/sh\n[ "$1" = apply ] && exec cat\necho "$@"\n')
    kubectl.chmod(0o755)
    keys = tmp_path / "config/robocomp/keys/Robot_1.kubernetes"
    shown = subprocess.run(
        [str(tmp_path / "build/create-secrets.sh")],
        env={"PATH": f"{kubectl.parent}:/usr/bin:/bin", "ROBOCOMP_KEYS": str(keys)},
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    sources = [word.rpartition("=")[2] for word in shown.split() if word.startswith("--from-file")]
    assert len(sources) == 9
    assert all(Path(source).is_file() for source in sources)
    assert "generic --dry-run=client --output yaml left-arm-keys" in shown

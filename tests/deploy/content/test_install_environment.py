"""Environments: installed by the real uv, complete whenever the installation is interrupted."""

from __future__ import annotations

import asyncio
import hashlib
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.content.host_session import ContentError, HostSession
from robocomp_dsl.deploy.content.on_host import environments as host_environments
from tests.deploy.content.killed_child import STEPS, killed_at
from tests.deploy.content.test_repack import UV, build_wheel
from tests.deploy.content.workspace_files import ROOT, local_connection

NAME = "e" * 64


@pytest.fixture(scope="module")
def uv_wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel with the program uv, not compressed."""
    path = tmp_path_factory.mktemp("uv") / "uv-1-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(UV, "uv-1.data/scripts/uv")
    return path


@pytest.fixture
def request_data(uv_wheel: Path, tmp_path: Path, home: Path) -> dict[str, Any]:
    """The request for an environment with one wheel, which is stored on the host."""
    wheel = build_wheel(tmp_path)
    folder = home / ROOT / "blobs"
    folder.mkdir(parents=True)
    digest = hashlib.sha256(wheel.read_bytes()).hexdigest()
    (folder / digest).hardlink_to(wheel)
    (folder / "uv").symlink_to(uv_wheel)
    return {
        "root": str(home / ROOT),
        "name": NAME,
        "python": sys.executable,
        "uv": "uv",
        "wheels": [(wheel.name, digest)],
        "requirements": f"two-parts==1.5 --hash=sha256:{digest}\n",
        "imports": ["two_parts"],
    }


def call(function: str, request: dict[str, Any]) -> dict[str, Any]:
    async def run() -> dict[str, Any]:
        async with HostSession(local_connection(), ROOT, sys.executable) as session:
            return await session.call(function, request)

    return asyncio.run(run())


def problem(home: Path) -> str:
    """What is wrong with the environment; empty if it is complete."""
    request = {"root": str(home / ROOT), "environments": [NAME]}
    found = host_environments.find_incomplete(request)["environments"]
    return str(found.get(NAME, ""))


def test_install_environment_is_complete_wherever_it_is_killed(
    home: Path, request_data: dict[str, Any]
) -> None:
    folder = home / ROOT / "environments"
    step = 1
    while killed_at(step, host_environments.install_environment, request_data, (*STEPS[2:], "os.")):
        assert problem(home) in ("missing", "")
        if not problem(home):
            break  # it died while it deleted what is no longer needed
        step += 1
    assert step > 10
    assert problem(home) == ""
    call("install_environment", request_data)  # it is there: nothing changes
    assert [entry.name for entry in folder.iterdir()] == [NAME]
    python = folder / NAME / "bin/python"
    code = "import two_parts; two_parts.main()"
    done = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "7\n"
    assert list(folder.glob(f"{NAME}/lib/python*/site-packages/two_parts/__pycache__/*.pyc"))


@pytest.mark.parametrize("damage", ["robocomp.json", "bin/python", "module"])
def test_install_environment_replaces_damaged_one(
    home: Path, request_data: dict[str, Any], damage: str
) -> None:
    call("install_environment", request_data)
    environment = home / ROOT / "environments" / NAME
    if damage == "module":
        (path,) = environment.glob("lib/python*/site-packages/two_parts/__init__.py")
    else:
        path = environment / damage
    path.unlink()
    assert problem(home)
    call("install_environment", request_data)
    assert problem(home) == ""


def test_install_environment_reports_what_uv_says(request_data: dict[str, Any], home: Path) -> None:
    wrong = {**request_data, "requirements": f"two-parts==1.5 --hash=sha256:{'0' * 64}\n"}
    with pytest.raises(
        ContentError, match=r"(?s)robot: `uv pip install` failed: .*Hash mismatch"
    ) as e:
        call("install_environment", wrong)
    assert e.value.kind == "installation"
    with pytest.raises(ContentError, match="No module named 'absent'"):
        call("install_environment", {**request_data, "imports": ["absent"]})
    with pytest.raises(ContentError, match="`uv venv` failed"):
        call("install_environment", {**request_data, "python": "/no/such/python"})
    assert problem(home) == "missing"
    assert not list((home / ROOT / "environments").iterdir())

"""Hosted processes for tests of units."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.process import Process
from robocomp_dsl.deploy.units.hosted_process import HOME, HostedProcess

ROOT = f"{HOME}/.local/share/robocomp/patrol"
PYTHON = f"{ROOT}/environments/e/bin/python"


def hosted(name: str = "arm", *, network: str = "", **fields: Any) -> HostedProcess:
    """A process of the deployment `patrol` on `robot`; `fields` are those of `Process`."""
    values = {
        "component": "arm",
        "argv": (PYTHON, "main.py", "--name", name),
        "cwd": Path(f"{ROOT}/trees/t/arm"),
        **fields,
    }
    return HostedProcess(
        Process(name, **values), "robot", ROOT, PYTHON, network=network, tree="t", environment="e"
    )


def settings(text: str, key: str) -> list[str]:
    """All values of a setting in a unit."""
    return [line[len(key) + 1 :] for line in text.splitlines() if line.startswith(f"{key}=")]

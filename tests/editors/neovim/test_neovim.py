"""A real Neovim with the configuration that we ship: the one of Debian, and a recent one."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp

from robocomp_dsl.language_server.server import FEATURES
from tests.support.real_editor import EDITORS, Project, missing, run
from tests.support.samples import FILES, MISTAKES, Mistake

pytestmark = pytest.mark.editors

DRIVE = Path(__file__).with_name("drive.lua")
NEWER = (0, 11)
"""The first version with `vim.lsp.config`."""


def neovims() -> dict[tuple[int, int], str]:
    """The programs called `nvim` on the PATH and beside this Python, by version."""
    folders = [str(Path(sys.executable).parent), *os.get_exec_path()]
    found: dict[tuple[int, int], str] = {}
    for folder in folders:
        program = Path(folder) / "nvim"
        if not os.access(program, os.X_OK):
            continue
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
        version = re.match(r"NVIM v(\d+)\.(\d+)", version.stdout)
        if version:
            found.setdefault((int(version[1]), int(version[2])), str(program))
    return found


@pytest.fixture(scope="module", params=["before 0.11", "0.11 or later"])
def seen(request: pytest.FixtureRequest, project: Project, home: Path) -> dict[str, Any]:
    """What a user of this Neovim sees in the project."""
    new = request.param == "0.11 or later"
    fitting = [neovim for version, neovim in neovims().items() if (version >= NEWER) == new]
    nvim = fitting[0] if fitting else missing(f"Neovim {request.param}")
    result = project.folder / f"result-{new}.json"
    config = f"set runtimepath^={EDITORS / 'neovim'} noswapfile"
    command = [nvim, "--headless", "-n", "-i", "NONE", "-u", "NORC", "--cmd", config]
    out = run([*command, "-S", DRIVE], project.folder, home, {"RESULT": str(result)})
    assert result.exists(), out
    report: dict[str, Any] = json.loads(result.read_text())
    assert "failure" not in report, f"{report['failure']}\n{out}"
    assert (tuple(report["version"]) >= NEWER) == new
    return report


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda case: case.file)
def test_neovim_shows_findings_at_position(seen: dict[str, Any], mistake: Mistake) -> None:
    ((line, column, message),) = seen["findings"][mistake.file]
    assert (line, column) == (mistake.line, mistake.column)
    assert mistake.message in message


def test_neovim_hover_shows_interface(seen: dict[str, Any]) -> None:
    assert "interface Scans::Laser" in seen["hover"]
    assert "A planar laser." in seen["hover"]


def test_neovim_completion_offers_interfaces(seen: dict[str, Any]) -> None:
    assert "Laser" in seen["completion"]


def test_neovim_definition_jumps_to_interface(seen: dict[str, Any]) -> None:
    assert seen["definition"] == ["Laser.idsl", 6, 14]


def test_neovim_rename_changes_all_open_files(seen: dict[str, Any]) -> None:
    assert "    interface Lidar" in seen["renamed"]["Laser.idsl"]
    assert "    Communications { requires Lidar; };" in seen["renamed"]["reader.cdsl"]


@pytest.mark.skipif(
    lsp.TEXT_DOCUMENT_FORMATTING not in FEATURES, reason="the server does not format"
)
def test_neovim_formats_file(seen: dict[str, Any]) -> None:
    assert "\n".join(seen["formatted"]) + "\n" == FILES["reader.cdsl"]


@pytest.mark.parametrize("new", [False, True], ids=["before 0.11", "0.11 or later"])
def test_neovim_without_server_shows_install_command(new: bool, home: Path, tmp_path: Path) -> None:
    fitting = [neovim for version, neovim in neovims().items() if (version >= NEWER) == new]
    nvim = fitting[0] if fitting else missing("this Neovim")
    config = f"set runtimepath^={EDITORS / 'neovim'} noswapfile"
    command = [nvim, "--headless", "-i", "NONE", "-u", "NORC", "--cmd", config, "a.idsl", "+qall!"]
    bare = {"PATH": str(tmp_path)}
    assert "pip install 'robocomp_dsl[editor]'" in run(command, tmp_path, home, bare)

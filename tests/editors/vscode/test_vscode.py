"""The extension in a real VS Code: its server, and its window in a browser that a script works."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support.real_editor import DEADLINE_S, EDITORS, Project, missing, need, run
from tests.support.samples import FILES, MISTAKES, Mistake

pytestmark = pytest.mark.editors

HOST = EDITORS.parent / "build" / "vscode-host"
DRIVE = Path(__file__).with_name("drive.js")
WORK_S = 240
"""Deadline for all that is done in the window."""
LOOPBACK = ("--host", "127.0.0.1", "--port", "0", "--without-connection-token")


@pytest.fixture(scope="module")
def command(vsix: Path, home: Path) -> list[str | Path]:
    """The command of a VS Code server in which the extension is installed."""
    if not list(HOST.glob("ready-*")):
        missing("VS Code's server")
    main = HOST / "node_modules/code-server/lib/vscode/out/server-main.js"
    own = ("--server-data-dir", home / "data", "--extensions-dir", home / "extensions")
    command = [need("node"), main, "--accept-server-license-terms", *own]
    run([*command, "--install-extension", vsix], home, home)
    return command


@pytest.fixture(scope="module")
def url(command: list[str | Path], project: Project, home: Path) -> Iterator[str]:
    """The address of the window on the project."""
    server = subprocess.Popen(
        [*command, *LOOPBACK],
        cwd=project.folder,
        env={**os.environ, "HOME": str(home)},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    assert server.stdout is not None
    silent = threading.Timer(DEADLINE_S, os.killpg, (server.pid, signal.SIGKILL))
    silent.start()
    matches = (re.search(r"Web UI available at (http://\S+)", line) for line in server.stdout)
    found = next((item[1] for item in matches if item), None)
    silent.cancel()
    try:
        assert found, "the server ended"
        yield f"{found}/?folder={project.folder}"
    finally:
        with suppress(ProcessLookupError):
            os.killpg(server.pid, signal.SIGTERM)
        server.communicate(timeout=DEADLINE_S)


@pytest.fixture(scope="module")
def seen(url: str, project: Project, home: Path) -> dict[str, Any]:
    """What a user of VS Code sees in the project."""
    browser = need("chromium")
    result = project.path("result.json")
    packages = {"NODE_PATH": str(HOST / "node_modules")}
    run([need("node"), DRIVE, url, browser, result], project.folder, home, packages, WORK_S)
    command: dict[str, Any] = json.loads(result.read_text())
    assert "failure" not in command, command["failure"]
    return command


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda item: item.file)
def test_vscode_shows_findings_at_position(seen: dict[str, Any], mistake: Mistake) -> None:
    rows = seen["problems"][mistake.file]
    place = f"[Ln {mistake.line + 1}, Col {mistake.column + 1}]"
    assert [row for row in rows if mistake.message in row and place in row], rows


def test_vscode_hover_shows_interface(seen: dict[str, Any]) -> None:
    assert "interface Scans::Laser" in seen["hover"]
    assert "A planar laser." in seen["hover"]


def test_vscode_definition_jumps_to_interface(seen: dict[str, Any]) -> None:
    assert seen["definition"] is True


def test_vscode_code_lens_shows_references_of_interface(seen: dict[str, Any]) -> None:
    assert seen["lens"] == "1 component requires this"
    assert "reader.cdsl" in seen["peek"]


def test_vscode_formats_file(seen: dict[str, Any], project: Project) -> None:
    assert project.path("ugly.cdsl").read_text() == FILES["reader.cdsl"]


def test_vscode_generate_runs_in_terminal(seen: dict[str, Any], project: Project) -> None:
    assert "class SpecificWorker" in project.path("specificworker.py").read_text()

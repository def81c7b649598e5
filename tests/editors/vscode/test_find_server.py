"""The search of the VS Code extension for `rcgen`."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from tests.support.real_editor import EDITORS, need

pytestmark = pytest.mark.editors

FOLDER = EDITORS / "vscode"
EVERYTHING = ("/w/.venv/bin/rcgen", "/py/bin/rcgen", "/usr/bin/rcgen", "/o/rcgen", "/w/t/rcgen")

CASES: list[tuple[dict[str, Any], tuple[str, ...], str | None]] = [
    ({}, EVERYTHING, "/w/.venv/bin/rcgen"),
    ({}, EVERYTHING[1:], "/py/bin/rcgen"),
    ({"interpreters": ["/py"]}, EVERYTHING[1:], "/py/bin/rcgen"),
    ({}, EVERYTHING[2:], "/usr/bin/rcgen"),
    ({}, EVERYTHING[3:], None),
    ({"configured": "/o/rcgen"}, EVERYTHING, "/o/rcgen"),
    ({"configured": "/nowhere/rcgen"}, EVERYTHING, None),
    ({"configured": "t/rcgen"}, EVERYTHING, "/w/t/rcgen"),
    ({"configured": "rcgen"}, EVERYTHING, "/usr/bin/rcgen"),
    ({"configured": "~/rcgen"}, ("/home/me/rcgen",), "/home/me/rcgen"),
    ({"folders": []}, EVERYTHING[:1], None),
]
"""Differences from `USUAL`, the programs that exist, and the expected program."""

USUAL = {
    "configured": "",
    "folders": ["/w"],
    "interpreters": ["/py/bin/python"],
    "searched": ["/bin", "/usr/bin"],
    "windows": False,
}
SCRIPT = """
const { findServer } = require(process.argv[1]);
const requests = JSON.parse(process.argv[2]);
const answers = requests.map(([places, there]) =>
  findServer({ ...places, isProgram: (file) => there.includes(file) }) ?? null);
console.log(JSON.stringify(answers));
"""


def test_vscode_find_server_searches_in_order(vsix: Path, tmp_path: Path) -> None:
    assert vsix.exists()  # building it installed esbuild
    module = tmp_path / "find_server.js"
    esbuild = FOLDER / "node_modules" / ".bin" / "esbuild"
    options = ("--bundle", "--platform=node", "--format=cjs", f"--outfile={module}")
    command = [esbuild, FOLDER / "src" / "find_server.ts", "--log-level=warning", *options]
    subprocess.run(command, check=True, timeout=60)
    requests = json.dumps([[{**USUAL, **places}, there] for places, there, _ in CASES])
    done = subprocess.run(
        [need("node"), "-e", SCRIPT, module, requests],
        env={"HOME": "/home/me", "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    found = json.loads(done.stdout)
    assert found == [expected for _, _, expected in CASES]

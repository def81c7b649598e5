"""The tester of TextMate grammars."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.real_editor import missing

TESTER = "vscode-tmgrammar-test"
FOLDER = Path(__file__).parents[3] / "build" / "npm"


@pytest.fixture(scope="session")
def tester() -> Path:
    """The tester, which is fetched into `build/` when it is not there."""
    program = FOLDER / "node_modules" / ".bin" / TESTER
    if not program.exists():
        npm = shutil.which("npm")
        if npm is None:
            missing("npm")
        FOLDER.mkdir(parents=True, exist_ok=True)
        fetch = [npm, "install", "--silent", "--no-audit", "--no-fund", "--prefix", FOLDER]
        subprocess.run([*fetch, f"{TESTER}@0.1.3"], check=True, timeout=300)
    return program

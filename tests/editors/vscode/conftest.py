"""The extension, built once as `make vsix` builds it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.real_editor import EDITORS, need


@pytest.fixture(scope="session")
def vsix() -> Path:
    """The file that a user installs."""
    for tool in ("node", "npm", "make"):
        need(tool)
    root = EDITORS.parent
    built = subprocess.run(
        ["make", "--no-print-directory", "vsix"],
        cwd=root,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert built.returncode == 0, built.stdout + built.stderr
    return root / "build" / "robocomp-dsl.vsix"

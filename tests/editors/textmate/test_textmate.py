"""The TextMate grammars, in the engine of VS Code: the marks beside the words in `words.*`."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.editors
HERE = Path(__file__).parent
ROOT = HERE.parents[2]
TESTER = "vscode-tmgrammar-test"
FOLDER = ROOT / "build" / "npm"


@pytest.fixture(scope="session")
def tester() -> Path:
    """The tester, which is fetched into `build/` when it is not there."""
    program = FOLDER / "node_modules" / ".bin" / TESTER
    if not program.exists():
        npm = shutil.which("npm")
        if npm is None:
            assert "CI" not in os.environ, "no npm"
            pytest.skip("no npm")
        FOLDER.mkdir(parents=True, exist_ok=True)
        fetch = [npm, "install", "--silent", "--no-audit", "--no-fund", "--prefix", FOLDER]
        subprocess.run([*fetch, f"{TESTER}@0.1.3"], check=True, timeout=300)
    return program


@pytest.mark.parametrize("file", sorted(HERE.glob("words.*")), ids=lambda file: file.name)
def test_words_have_their_scopes(tester: Path, file: Path) -> None:
    grammar = ROOT / "editors/vscode/syntaxes" / f"{file.suffix[1:]}.tmLanguage.json"
    done = subprocess.run(
        [tester, "-g", grammar, file], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "run successfuly" in done.stdout

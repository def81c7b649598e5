"""The TextMate grammars, in the engine of VS Code: the marks beside the words in `words.*`."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.editors
HERE = Path(__file__).parent
ROOT = HERE.parents[2]


@pytest.mark.parametrize("file", sorted(HERE.glob("words.*")), ids=lambda file: file.name)
def test_textmate_grammar_gives_expected_scopes(tester: Path, file: Path) -> None:
    grammar = ROOT / "editors/vscode/syntaxes" / f"{file.suffix[1:]}.tmLanguage.json"
    done = subprocess.run(
        [tester, "-g", grammar, file], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "run successfuly" in done.stdout

"""Scopes of whole files of the project, as VS Code's engine gives them, against kept ones.

`pytest -m editors --update-golden tests/editors/textmate` rewrites them; read the diff then.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.editors
HERE = Path(__file__).parent
ROOT = HERE.parents[2]
FILES = (
    "interfaces/Component.idsl",
    "components/wander/wander.cdsl",
    "components/wander/wander.ddsl",
    "components/mobile_base/mobile_base.pdsl",
    "tests/cases/smdsl/sem_clean.smdsl",
    "tests/cases/bdsl/syntax_clean.bdsl",
)


@pytest.mark.parametrize("name", FILES)
def test_textmate_scopes_equal_snapshot(
    tester: Path, name: str, tmp_path: Path, update_golden: bool
) -> None:
    file = Path(shutil.copy(ROOT / name, tmp_path))
    expected_file = HERE / "snapshots" / f"{file.name}.snap"
    new_file = file.with_name(expected_file.name)
    grammar = ROOT / "editors/vscode/syntaxes" / f"{file.suffix[1:]}.tmLanguage.json"
    scope = f"source.{file.suffix[1:]}"
    program = tester.with_name("vscode-tmgrammar-snap")
    subprocess.run(
        [program, "-u", "-g", grammar, "-s", scope, file],
        capture_output=True,
        timeout=120,
        check=True,
    )
    if update_golden:
        expected_file.parent.mkdir(exist_ok=True)
        shutil.copy(new_file, expected_file)
    assert new_file.read_text(encoding="utf-8") == expected_file.read_text(encoding="utf-8")

"""What is generated for the golden cases is what stands beside them, byte for byte."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.generate import golden_cases as golden

EXPECTED = "expected"


@pytest.mark.parametrize("case", golden.CASES)
def test_golden(case: str, update_golden: bool) -> None:
    folder = golden.GOLDEN / case / EXPECTED
    files = golden.files(case)
    if update_golden:
        shutil.rmtree(folder, ignore_errors=True)
        golden.put(files, folder)
    found = {
        str(p.relative_to(folder)): p.read_text("utf-8")
        for p in folder.rglob("*")
        if p.is_file() and p.parent.name != "__pycache__"
    }
    for file in files:
        assert file.text == found.pop(file.path, None), file.path
    assert not found


HASHED = """
import sys
from pathlib import Path
from tests.generate import golden_cases as golden
for file in golden.files(sys.argv[1]):
    sys.stdout.buffer.write(file.data)
"""


@pytest.mark.parametrize("case", ["types", "renamed"])
def test_generated_files_are_independent_of_hash_seed(case: str) -> None:
    """The order of sets differs between the processes."""
    outputs = {
        subprocess.run(
            [sys.executable, "-c", HASHED, case],
            env={**os.environ, "PYTHONHASHSEED": seed},
            cwd=Path(__file__).parents[2],
            check=True,
            capture_output=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(outputs) == 1


@pytest.mark.parametrize("case", golden.CASES)
def test_generated_files_contain_no_machine_path_or_date(case: str) -> None:
    for file in golden.files(case):
        assert str(golden.GOLDEN) not in file.text
        assert "/home" not in file.text
        assert not re.search(r"20\d\d-\d\d-\d\d", file.text)

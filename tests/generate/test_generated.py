"""Generated code as Python: formatted, clean, typed; what it says about itself is true."""

from __future__ import annotations

import importlib
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import jsonschema
import pytest
import yaml

from robocomp_dsl.generate import interface_code, names, params, type_code, worker
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.parameters import Parameters
import golden_cases as golden

MYPY = ["--strict", "--no-error-summary", "--no-color-output"]


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All cases, each in its folder."""
    folder = tmp_path_factory.mktemp("generated")
    for case in golden.CASES:
        golden.put(golden.files(case), folder / case)
    return folder


def test_ruff_finds_nothing(generated: Path) -> None:
    for command in (["check"], ["format", "--diff"]):
        done = subprocess.run(
            [str(shutil.which("ruff")), *command, "--isolated", "--no-cache", "."],
            cwd=generated,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("case", golden.CASES)
def test_mypy_finds_nothing(generated: Path, case: str, tmp_path: Path) -> None:
    cache = tmp_path.parent / "mypy-cache"
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *MYPY, f"--cache-dir={cache}", "--config-file=", "."],
        cwd=generated / case,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == ""
    assert done.returncode == 0, done.stderr

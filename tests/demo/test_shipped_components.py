"""The shipped components are as a user would have them: generated files fresh, code typed."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.demo.component_modules import COMPONENTS

RCGEN = Path(sys.executable).with_name("rcgen")
MYPY = (sys.executable, "-m", "mypy", "--strict", "--config-file", "", "--ignore-missing-imports")
NAMES = sorted(path.stem for path in COMPONENTS.glob("*/*.cdsl"))


def test_shipped_components_exist() -> None:
    assert {"mobile_base", "wander", "path_logger"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_shipped_components_are_freshly_generated(name: str) -> None:
    ran = subprocess.run(
        [RCGEN, "component", f"{name}.cdsl", "--check"],
        cwd=COMPONENTS / name,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_shipped_descriptions_have_no_findings() -> None:
    files = [path for path in COMPONENTS.glob("*/*") if path.suffix in {".cdsl", ".pdsl", ".ddsl"}]
    ran = subprocess.run(
        [RCGEN, "check", *files], capture_output=True, text=True, timeout=60, check=False
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "no findings" in ran.stdout + ran.stderr


def test_shipped_components_pass_mypy_strict() -> None:
    """One after the other, since each has a module called `specificworker`."""
    wrong = []
    for name in NAMES:
        modules = sorted(path.name for path in (COMPONENTS / name).glob("*.py"))
        ran = subprocess.run(
            [*MYPY, *modules],
            cwd=COMPONENTS / name,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        if ran.returncode:
            wrong.append(f"{name}:\n{ran.stdout}{ran.stderr}")
    assert not wrong, "\n".join(wrong)

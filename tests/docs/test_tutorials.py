"""Every command of README and tutorials is executed, and the output that they show is compared."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.docs.blocks import PAGES, ROOT, Block, blocks
from tests.docs.session import Session, replace_methods


def _make_target_exists(line: str) -> None:
    target = line.split()[1]
    subprocess.run(["make", "-n", target], cwd=ROOT, check=True, capture_output=True)


def _extra_exists(line: str) -> None:
    extra = line.partition("[")[2].partition("]")[0]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert extra in project["optional-dependencies"]
    assert line == f"pip install '{project['name']}[{extra}]'"


def _creates_environment(line: str) -> None:
    create, _, activate = line.partition(" && ")
    assert create == "python3 -m venv .venv"
    assert activate == ". .venv/bin/activate"


CHECKED_OTHERWISE: dict[str, Callable[[str], None]] = {
    "python3 -m venv .venv && . .venv/bin/activate": _creates_environment,
    "pip install 'robocomp_dsl[all]'": _extra_exists,
    "make demo": _make_target_exists,
    "make test": _make_target_exists,
}
"""Commands that are not executed here: they take minutes or install from an index. `make demo` runs
in `tests/demo`, the installation of a wheel in `tests/packaging`, and `make test` runs this."""


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    commands = Path(sys.executable).parent
    return os.environ | {
        "PATH": f"{commands}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT),
        "PYTHONUNBUFFERED": "1",
        "HOME": str(tmp_path),
        "COLUMNS": "100",
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_executes_as_shown(page: Path, tmp_path: Path, environment: dict[str, str]) -> None:
    work = tmp_path / "work"
    work.mkdir()
    with Session(work, environment) as session:
        for block in blocks(page):
            session.execute(block)


def _shell_lines() -> list[str]:
    lines = [
        line.partition("#")[0].strip()
        for page in PAGES
        for block in blocks(page)
        if block.language in ("sh", "bash", "shell")
        for line in block.text.splitlines()
    ]
    return [line for line in lines if line]


@pytest.mark.parametrize("line", _shell_lines())
def test_command_that_is_not_executed_is_checked_otherwise(line: str) -> None:
    CHECKED_OTHERWISE[line](line)


def test_list_of_commands_checked_otherwise_has_no_stale_entry() -> None:
    assert set(CHECKED_OTHERWISE) == set(_shell_lines())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_block_of_a_page_is_executed_or_an_illustration(page: Path) -> None:
    unknown = [block for block in blocks(page) if not _is_covered(block)]
    assert [(block.line, block.language) for block in unknown] == []


def _is_covered(block: Block) -> bool:
    illustration = block.language in ("text", "{toctree}", "sh")
    return illustration or block.language == "console" or block.verb in ("file", "method")


def test_replace_methods_keeps_the_rest_of_the_class(tmp_path: Path) -> None:
    path = tmp_path / "worker.py"
    path.write_text("class W:\n    def a(self):\n        pass\n        # hint\n\n    b = 1\n")
    replace_methods(
        path, "import re\n\ndef a(self):\n    return re\n\ndef c(self):\n    return 2\n"
    )
    namespace: dict[str, type] = {}
    exec(path.read_text(), namespace)
    worker = namespace["W"]()
    assert (worker.a().__name__, worker.b, worker.c()) == ("re", 1, 2)
    assert "hint" not in path.read_text()

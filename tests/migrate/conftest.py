"""Fixtures of the migration tests."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from robocomp_dsl.cli import program
from robocomp_dsl.cli.rcgen.main import program as rcgen_program

OLD = Path(__file__).parent / "old"
"""Components in RoboComp's format."""


@dataclass(frozen=True)
class Run:
    """The result of a command."""

    code: int
    out: str
    err: str


@pytest.fixture
def rcgen(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., Run]:
    """`rcgen("check", "x.cdsl")` as on a command line."""

    def run(*arguments: object) -> Run:
        monkeypatch.setattr(sys, "argv", ["rcgen", *map(str, arguments)])
        try:
            code = program._exit_code(rcgen_program, "rcgen")
        except SystemExit as leaving:
            code = leaving.code if isinstance(leaving.code, int) else 1
        shown = capsys.readouterr()
        return Run(code, shown.out, shown.err)

    monkeypatch.setenv("NO_COLOR", "1")
    return run


@pytest.fixture
def old() -> Path:
    """The folder with the old components."""
    return OLD

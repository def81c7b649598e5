"""Runs `rcgen` inside the test's process."""

from __future__ import annotations

import sys
from dataclasses import dataclass

import pytest

from robocomp_dsl.cli import program
from robocomp_dsl.cli.rcgen.main import program as rcgen


@dataclass(frozen=True)
class Run:
    """Exit code and output of a command."""

    code: int
    out: str
    err: str


class Rcgen:
    """`rcgen("check", "x.cdsl")` as on a command line."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
        self.monkeypatch = monkeypatch
        self.capsys = capsys

    def __call__(self, *arguments: object) -> Run:
        self.monkeypatch.setattr(sys, "argv", ["rcgen", *map(str, arguments)])
        try:
            code = program._exit_code(rcgen, "rcgen")
        except SystemExit as leaving:
            code = leaving.code  # type: ignore[assignment]
        shown = self.capsys.readouterr()
        return Run(code, shown.out, shown.err)

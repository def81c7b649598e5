"""Before and after, for every language: `cases/NAME` becomes `cases/NAME.out`."""

from __future__ import annotations

from pathlib import Path

import pytest
from formats import CASES, fmt

from robocomp_dsl.check import CHECKS
from robocomp_dsl.format import PARSERS

CASE_FILES = sorted(path for path in CASES.iterdir() if path.suffix != ".out")


@pytest.mark.parametrize("case", CASE_FILES, ids=lambda path: path.name)
def test_case(case: Path, update_golden: bool) -> None:
    made = fmt(case.name, case.read_text(encoding="utf-8"))
    assert made is not None, "the case has errors"
    beside = case.with_name(f"{case.name}.out")
    if update_golden:
        beside.write_text(made, encoding="utf-8")
    assert made == beside.read_text(encoding="utf-8")


def test_every_language_is_formatted_and_has_a_case() -> None:
    assert {case.suffix for case in CASE_FILES} == set(PARSERS) == set(CHECKS)

"""Before and after, for every language: `cases/NAME` becomes `cases/NAME.out`."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.languages import CHECKS
from robocomp_dsl.format.formatter import PARSERS
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES
from tests.format.formats import CASES, fmt

CASE_FILES = sorted(path for path in CASES.iterdir() if path.suffix != ".out")


@pytest.mark.parametrize("case", CASE_FILES, ids=lambda path: path.name)
def test_format_case(case: Path, update_golden: bool) -> None:
    result = fmt(case.name, case.read_text(encoding="utf-8"))
    assert result is not None, "the case has errors"
    beside = case.with_name(f"{case.name}.out")
    if update_golden:
        beside.write_text(result, encoding="utf-8")
    assert result == beside.read_text(encoding="utf-8")


def test_every_format_language_has_a_case() -> None:
    # The layout of definitions belongs to the packages of ROS and YARP that declare them.
    assert (
        {case.suffix for case in CASE_FILES} == set(PARSERS) == set(CHECKS) - {*DEFINITION_SUFFIXES}
    )

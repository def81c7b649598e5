"""Input files and the expected diagnostics: `cases/<dsl>/sem_*`, or a `main` file in a folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.languages import CHECKS, TACTILE, check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.explain import stage_codes
from robocomp_dsl.diagnostics import Code, Report
from tests.check.other_middlewares import BRIDGED_MIDDLEWARES, OTHER_MIDDLEWARES
from tests.check.report_text import report_text

HERE = Path(__file__).parent.parent
CASES = Path("cases")
INTERFACES = CASES / "interfaces"
FAMILIES = ("RC2", "RC3", "RC4", "RC5", "RC7", "RC82")


def _cases() -> list[Path]:
    files = [
        path
        for pattern in ("*/sem_*", "*/sem_*/main.*")
        for path in (HERE / CASES).glob(pattern)
        if path.is_file() and path.suffix in {*CHECKS, *TACTILE}
    ]
    return sorted(path.relative_to(HERE) for path in files)


def _expected(case: Path) -> Path:
    named = case.parent if case.stem == "main" else case
    return named.with_name(f"{named.stem}.diag.txt")


@pytest.fixture(autouse=True)
def _in_tests(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(HERE)  # messages contain relative paths only


def _workspace(case: Path) -> Workspace:
    middlewares = BRIDGED_MIDDLEWARES if case.suffix == ".bdsl" else OTHER_MIDDLEWARES
    return Workspace(environ={}, shipped=INTERFACES, middlewares=middlewares)


@pytest.mark.parametrize("case", _cases(), ids=str)
def test_check_file_reports_expected_diagnostics(case: Path, update_golden: bool) -> None:
    report = Report()
    check_file(case, _workspace(case), report)
    actual = report_text(report, case.parent)
    if update_golden:
        _expected(case).write_text(actual)
    assert _expected(case).read_text() == actual


@pytest.mark.parametrize("case", _cases(), ids=str)
def test_check_file_is_idempotent(case: Path) -> None:
    workspace = _workspace(case)
    first, second = Report(), Report()
    check_file(case, workspace, first)
    check_file(case, workspace, second)
    assert report_text(first, case.parent) == report_text(second, case.parent)


def _codes() -> list[Code]:
    return [code for code in stage_codes("check") if code.id.startswith(FAMILIES)]


def test_every_code_has_a_case() -> None:
    expected = "".join(_expected(case).read_text() for case in _cases())
    covered_elsewhere = {"RC569", "RC210", "RC220", "RC317", "RC709"}  # see test_limits.py
    covered_elsewhere |= {"RC788"}  # see tests/cli/test_rcgen_world_files.py
    missing = [c.id for c in _codes() if c.id not in covered_elsewhere and c.id not in expected]
    assert missing == []


def test_codes_are_well_formed() -> None:
    codes = _codes()
    assert len({code.id for code in codes}) == len(codes)
    for code in codes:
        assert code.title
        assert not code.title.endswith(".")
        assert code.explanation.endswith("\n")
        assert "\n    " in code.explanation or code.id in ("RC210", "RC317", "RC709"), code.id

"""Files, and beside them what is found in them: `cases/<dsl>/sem_*`, or a `main` in a folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from shown import shown

from robocomp_dsl.check import CHECKS, TACTILE, check_file, codes
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Code, Report

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
    whole = case.parent if case.stem == "main" else case
    return whole.with_name(f"{whole.stem}.diag.txt")


@pytest.fixture(autouse=True)
def _in_tests(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(HERE)  # so that messages name no folder of this machine


@pytest.mark.parametrize("case", _cases(), ids=str)
def test_case(case: Path, update_golden: bool) -> None:
    report = Report()
    check_file(case, Workspace(environ={}, shipped=INTERFACES), report)
    found = shown(report, case.parent)
    if update_golden:
        _expected(case).write_text(found)
    assert _expected(case).read_text() == found


@pytest.mark.parametrize("case", _cases(), ids=str)
def test_again_finds_the_same(case: Path) -> None:
    workspace = Workspace(environ={}, shipped=INTERFACES)
    first, second = Report(), Report()
    check_file(case, workspace, first)
    check_file(case, workspace, second)
    assert shown(first, case.parent) == shown(second, case.parent)


def _codes() -> list[Code]:
    known = [one for one in vars(codes).values() if isinstance(one, Code)]
    return [one for one in known if one.id.startswith(FAMILIES)]


def test_every_code_has_a_case() -> None:
    expected = "".join(_expected(case).read_text() for case in _cases())
    elsewhere = {"RC210", "RC220", "RC317", "RC709"}  # see test_limits.py
    missing = [one.id for one in _codes() if one.id not in elsewhere and one.id not in expected]
    assert missing == []


def test_codes_are_well_formed() -> None:
    known = _codes()
    assert len({one.id for one in known}) == len(known)
    for one in known:
        assert one.title
        assert not one.title.endswith(".")
        assert one.explanation.endswith("\n")
        assert "\n    " in one.explanation or one.id in ("RC210", "RC317", "RC709"), one.id

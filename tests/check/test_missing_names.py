"""A declaration without a name: one error there, whose fix inserts the name that is used."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.token_faults import apply, find_errors, tokens
from tests.check.test_misspelled_declarations import BDSL, IDSL, SMDSL

MORE = SMDSL.replace("Busy => Waiting", "Busy => Ill, Waiting")
LAST, FIRST = (
    MORE.replace("states Busy", f"states {names}") for names in ("Busy, Ill", "Ill, Busy")
)
CASES = [
    (".idsl", IDSL, "struct Point3D", "struct", "Point3D", 2),
    (".idsl", IDSL, "enum Mode", "enum", "Mode", 1),
    (".idsl", IDSL, "> Points", ">", "Points", 1),
    (".idsl", IDSL, "exception Lost", "exception", "Lost", 2),
    (".smdsl", SMDSL, "end_state Over", "end_state", "Over", 1),
    (".smdsl", SMDSL, "states Busy", "states", "Busy", 3),
    (".smdsl", LAST, "Busy, Ill", "Busy,", "Ill", 1),
    (".smdsl", FIRST, "Ill, Busy", ", Busy", "Ill", 1),
    (".bdsl", BDSL, "input joints", "input", "joints", 5),
    (".bdsl", BDSL, "hub newest", "hub", "newest", 1),
    (".bdsl", BDSL, "(double left [deg]", "(double [deg]", "left", 1),
]


@pytest.mark.parametrize(("suffix", "text", "right", "wrong", "name", "uses"), CASES)
def test_missing_name_is_inserted_where_it_is_used_but_not_declared(
    suffix: str, text: str, right: str, wrong: str, name: str, uses: int, tmp_path: Path
) -> None:
    path = tmp_path / f"x{suffix}"
    assert not find_errors(path, text)
    changed = text.replace(right, wrong, 1)
    (error,) = find_errors(path, changed)
    assert error.label == f"did you mean `{name}`?"
    assert error.fix
    assert [token.text for token in tokens(apply(changed, error.fix), suffix)] == [
        token.text for token in tokens(text, suffix)
    ]
    line = changed.count("\n", 0, changed.index(wrong))
    assert line <= error.span.start_position[0] - 1 <= line + 1
    assert [note.span.text for note in error.notes] == [name] * uses


def test_unknown_name_that_does_not_fit_is_not_inserted(tmp_path: Path) -> None:
    text = SMDSL.replace("on started", "on started after").replace("Busy => Waiting", "Busy => Far")
    errors = find_errors(tmp_path / "x.smdsl", text)
    assert [error.message for error in errors if error.unknown] == ["unknown state `Far`"]


def test_error_that_the_name_does_not_explain_remains(tmp_path: Path) -> None:
    text = IDSL.replace("struct Point3D", "struct").replace("Mode mode()", "Nothing mode()")
    errors = find_errors(tmp_path / "x.idsl", text)
    assert [error.label for error in errors] == ["did you mean `Point3D`?", ""]
    assert errors[1].message == "unknown type `Nothing`"


def test_rcgen_check_of_missing_name_leaves_other_text_unchanged(tmp_path: Path) -> None:
    text = IDSL.replace("enum Mode { Idle", "enum // of the finder\n { Idle")
    (error,) = find_errors(tmp_path / "x.idsl", text)
    assert error.fix
    assert "// of the finder\n Mode { Idle" in apply(text, error.fix)

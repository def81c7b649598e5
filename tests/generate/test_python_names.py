"""How names of the languages become names of Python."""

from __future__ import annotations

import builtins
import keyword

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.generate import names

CASES = [
    ("dist", (), "dist"),
    ("id", (), "id"),
    ("type", (), "type"),
    ("len", (), "len"),
    ("match", (), "match"),
    ("lambda", (), "lambda_"),
    ("None", (), "None_"),
    ("self", (), "self_"),
    ("close", ("close",), "close_"),
    ("_x", (), "x_"),
    ("__init__", (), "init____"),
    ("_", (), "n_"),
    ("__", (), "n__"),
    ("_1", (), "n1_"),
    ("__class", (), "class__"),
]


@pytest.mark.parametrize(("name", "reserved", "expected"), CASES)
def test_identifier_escapes_reserved_words(
    name: str, reserved: tuple[str, ...], expected: str
) -> None:
    assert names.identifier(name, reserved) == expected


IDS = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,4}", fullmatch=True)


@given(st.lists(IDS, max_size=12))
def test_unique_gives_different_identifiers_for_any_names(raw_names: list[str]) -> None:
    found = names.unique(raw_names, names.ANNOTATION)
    assert len(set(found)) == len(raw_names)
    for name in found:
        assert name.isidentifier()
        assert not keyword.iskeyword(name)
        assert not name.startswith("_")
        assert name not in names.ANNOTATION
        assert name != "self"


def test_unique_resolves_clashes_with_underscores() -> None:
    assert names.unique(["x_", "_x", "x"]) == ("x_", "x__", "x")


def test_builtins_table_is_complete() -> None:
    known = {n for n in dir(builtins) if not n.startswith("_") and not keyword.iskeyword(n)}
    known -= {"qApp"}  # PySide6 adds it when it is imported
    assert known <= names.BUILTINS


@pytest.mark.parametrize(
    ("name", "expected"), [("speech", "Speech"), ("my_arm", "MyArm"), ("aBC", "ABC"), ("_", "")]
)
def test_camel_converts_names(name: str, expected: str) -> None:
    assert names.camel(name) == expected

"""The user's texts in source: they always come back as they were, and never become code."""

from __future__ import annotations

import ast
import inspect
import math

import pytest
import yaml
from hypothesis import example, given
from hypothesis import strategies as st

from robocomp_dsl.generate import literals

TEXTS = st.text(max_size=60) | st.text("\"'\\\n{}%#*/ax\t\r\u2028", max_size=30)
NASTY = [
    '"',
    '""',
    '"""',
    'a"',
    'a\\"',
    "\\",
    '\\"""',
    '"""\\',
    "{{ 7 * 7 }}",
    "{% raw %}",
    'a"""\nimport os',
    "\u2028x",
    "\x1b[31m",
    "a\r\nb",
    "a\x85key: 1",
    "\ud800",
]


@pytest.mark.parametrize("text", NASTY[:-1])
def test_nasty_texts_in_a_docstring(text: str) -> None:
    check_docstring(text)


@given(TEXTS)
def test_any_text_in_a_docstring(text: str) -> None:
    check_docstring(text)


def check_docstring(text: str) -> None:
    shown = literals.lines(text)
    source = f"class A:\n    {literals.docstring(text, '    ')}\n    x = 1\n"
    namespace: dict[str, type] = {}
    exec(source, namespace)
    assert namespace["A"].__dict__["x"] == 1
    assert (inspect.getdoc(namespace["A"]) or "").split("\n") == (shown or [""])


@given(TEXTS)
@example("he\"l'lo")
def test_any_text_as_a_python_string(text: str) -> None:
    for write in (literals.python_string, literals.quoted):
        source = write(text)
        assert ast.literal_eval(source) == text
        assert source.isprintable()


@given(st.text(max_size=60))
def test_any_text_as_a_yaml_value(text: str) -> None:
    assert yaml.safe_load(f"a: {literals.yaml_value(text)}\n") == {"a": text}


@given(st.integers() | st.booleans() | st.floats(allow_nan=False))
def test_any_number_as_a_yaml_and_python_value(value: float) -> None:
    for found in (
        yaml.safe_load(f"a: {literals.yaml_value(value)}\n")["a"],
        eval(literals.python_value(value), {"float": float}),
    ):
        assert found == value
        assert type(found) is type(value)


def test_not_a_number() -> None:
    assert math.isnan(yaml.safe_load(literals.yaml_value(math.nan)))


@given(TEXTS)
def test_comments_stay_comments(text: str) -> None:
    for line in literals.comment(text, "  "):
        assert line.startswith("  # ")
        assert line.isprintable()


@pytest.mark.parametrize("name", ["rate", "on", "yes", "null", "y", "NO", "_x", "true"])
def test_yaml_keys(name: str) -> None:
    assert yaml.safe_load(f"{literals.yaml_key(name)}: 1\n") == {name: 1}


LINES = [
    ("", []),
    ("  one  ", ["one"]),
    ("one\n   two\n     three\n", ["one", "two", "  three"]),
    ("one\r\ntwo\rthree", ["one", "two", "three"]),
    ("a\tb", ["a   b"]),
    ("a\x00b", ["a\\x00b"]),
]


@pytest.mark.parametrize(("text", "expected"), LINES)
def test_lines(text: str, expected: list[str]) -> None:
    assert literals.lines(text) == expected


def test_markdown_cells_end_nowhere() -> None:
    assert literals.markdown_cell("a|b\n<c> `d`") == "a\\|b \\<c\\> \\`d\\`"


@pytest.mark.parametrize(
    ("text", "expected"),
    [("", ""), ("50.0", "`50.0`"), ("a|b", "`a\\|b`"), ("a`b", "`` a`b ``")],
)
def test_markdown_code(text: str, expected: str) -> None:
    assert literals.markdown_code(text) == expected

"""Literals in generated source: texts are kept and never become code."""

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
HOSTILE = [
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


@pytest.mark.parametrize("text", HOSTILE[:-1])
def test_docstring_keeps_hostile_text(text: str) -> None:
    check_docstring(text)


@given(TEXTS)
def test_docstring_keeps_any_text(text: str) -> None:
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
def test_python_string_keeps_any_text(text: str) -> None:
    for write in (literals.python_string, literals.quoted):
        source = write(text)
        assert ast.literal_eval(source) == text
        assert source.isprintable()


@given(st.text(max_size=60))
def test_yaml_value_keeps_any_text(text: str) -> None:
    assert yaml.safe_load(f"a: {literals.yaml_value(text)}\n") == {"a": text}


@given(st.integers() | st.booleans() | st.floats(allow_nan=False))
def test_yaml_and_python_values_keep_any_number(value: float) -> None:
    for found in (
        yaml.safe_load(f"a: {literals.yaml_value(value)}\n")["a"],
        eval(literals.python_value(value), {"float": float}),
    ):
        assert found == value
        assert type(found) is type(value)


def test_yaml_value_of_nan() -> None:
    assert math.isnan(yaml.safe_load(literals.yaml_value(math.nan)))


@given(TEXTS)
def test_comment_stays_comment_for_any_text(text: str) -> None:
    for line in literals.comment(text, "  "):
        assert line.startswith("  # ")
        assert line.isprintable()


@pytest.mark.parametrize("name", ["rate", "on", "yes", "null", "y", "NO", "_x", "true"])
def test_yaml_key_quotes_reserved_words(name: str) -> None:
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
def test_lines_strips_indentation_and_control_characters(text: str, expected: list[str]) -> None:
    assert literals.lines(text) == expected


def test_markdown_cell_escapes_delimiters() -> None:
    assert literals.markdown_cell("a|b\n<c> `d`") == "a\\|b \\<c\\> \\`d\\`"


@pytest.mark.parametrize(
    ("text", "expected"),
    [("", ""), ("50.0", "`50.0`"), ("a|b", "`a\\|b`"), ("a`b", "`` a`b ``")],
)
def test_markdown_code_escapes_delimiters(text: str, expected: str) -> None:
    assert literals.markdown_code(text) == expected

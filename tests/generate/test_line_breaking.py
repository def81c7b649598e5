"""Line breaking: long items are broken as `ruff format` breaks them."""

from __future__ import annotations

import shutil
import subprocess

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.generate.python import layout
from robocomp_dsl.generate.python.layout import Brackets, Item

LONG = "a_name_of_about_fifty_characters_which_is_really_long"

CASES = [
    (layout.call("f", "a", "b"), "f(a, b)"),
    (layout.tuple_of("a"), "(a,)"),
    (layout.tuple_of(), "()"),
    (layout.subscript("tuple", "int"), "tuple[int]"),
    (layout.call("f", layout.tuple_of("a", head="x=")), "f(x=(a,))"),
    (layout.call("f", LONG, LONG), f"f(\n    {LONG},\n    {LONG},\n)"),
    (
        layout.call("f", "a", layout.call("g", LONG, LONG)),
        f"f(\n    a,\n    g(\n        {LONG},\n        {LONG},\n    ),\n)",
    ),
    (
        Brackets("a + (", (LONG + LONG,), ")"),
        f"a + (\n    {LONG}{LONG}\n)",
    ),
    (
        layout.subscript("list", LONG + LONG),
        f"list[\n    {LONG}{LONG}\n]",
    ),
]


@pytest.mark.parametrize(("item", "expected"), CASES)
def test_laid_out_breaks_long_items(item: Item, expected: str) -> None:
    assert layout.laid_out(item) == expected


def test_laid_out_counts_used_columns_and_indent() -> None:
    item = layout.call("f", "a" * 40, "b" * 40)
    assert "\n" not in layout.laid_out(item)
    assert "\n" in layout.laid_out(item, used=10)
    assert "\n" in layout.laid_out(item, indent="        ")


def test_definition_breaks_long_return_type() -> None:
    returns = layout.subscript("tuple", LONG, LONG, "int")
    text = layout.definition("f", ("self", "a: int"), returns)
    assert text.endswith(f") -> tuple[\n        {LONG},\n        {LONG},\n        int,\n    ]:")


def items(depth: int) -> st.SearchStrategy[Item]:
    names = st.text("abc", min_size=1, max_size=40).map(lambda n: f"x{n}")
    if not depth:
        return names
    inner = st.lists(items(depth - 1), max_size=5).map(tuple)
    return st.one_of(
        names,
        st.builds(lambda i: layout.call("f", *i), inner),
        st.builds(lambda i: layout.tuple_of(*i), inner),
        st.builds(lambda i: Brackets("{", i, "}"), inner),
    )


@settings(max_examples=4)
@given(st.lists(items(3), min_size=60, max_size=60))
def test_layout_equals_ruff_format(layout_items: list[Item]) -> None:
    text = "".join(layout.statement("value = ", item) + "\n" for item in layout_items)
    assert formatted(text) == text


def formatted(text: str) -> str:
    ruff = shutil.which("ruff")
    assert ruff
    command = [ruff, "format", "--isolated", "--stdin-filename", "a.py", "-"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    return done.stdout


def test_natural_sort_order() -> None:
    names = ["a", "a2", "a10", "B", "_x", "b"]
    assert sorted(names, key=layout.natural) == ["B", "_x", "a", "a2", "a10", "b"]

"""What `formatted` refuses, and what it keeps of the form of a file."""

from __future__ import annotations

from pathlib import Path

import pytest
from formats import fmt, parse

from robocomp_dsl.format import CannotFormat, changes, formatted
from robocomp_dsl.source import Source


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("x.cdsl", "Component {"),
        ("x.idsl", ""),
        ("x.idsl", "module M { struct S { int a; /* open };"),
        ("x.cdsl", "<<<<<<< ours\nComponent a { language Python; };\n=======\n>>>>>>> theirs\n"),
        ("x.pdsl", "module M { struct S { int a; }; };"),
        ("x.xml", "<a><b></a>"),
        ("x.xml", '<a x="1" x="2"/>'),
    ],
)
def test_errors_of_form(name: str, text: str) -> None:
    assert fmt(name, text) is None


def test_a_suffix_of_no_language() -> None:
    with pytest.raises(KeyError):
        formatted(Source(Path("x.txt"), ""), [])


@pytest.mark.parametrize(
    ("text", "end"),
    [
        ("a {\n states b; };", "\n"),
        ("a {\r\n states b; };", "\r\n"),
        ("a {\r\n states b;\r\n };\n", "\r\n"),
        ("a {\r\n states b;\n };\n", "\n"),
        ("a { states b,\r\n c; };", "\r\n"),
    ],
)
def test_line_ends_are_those_of_most_lines(text: str, end: str) -> None:
    made = fmt("a.smdsl", text)
    assert made is not None
    assert made.replace(end, "").count("\n") == made.replace(end, "").count("\r") == 0
    assert made.endswith(f"}};{end}")


def test_the_suffix_may_be_in_capitals() -> None:
    assert formatted(Source(Path("A.SMDSL"), "a{states b;};"), []) == "a { states b; };\n"


MANY = "".join(f"    int p{n}\n" for n in range(150))
"""More fields without a `;` than the parser has findings for one file."""


def test_more_legacy_forms_than_are_reported() -> None:
    text = f"module M {{ struct S\n{{\n{MANY}}}; }};\n"
    found = list(parse("a.idsl", text)[1])
    with pytest.raises(CannotFormat, match="mend them first"):
        formatted(Source(Path("a.idsl"), text), found)


def test_many_legacy_forms_that_change_nothing() -> None:
    lines = [f"p{number} int 1;;\n" for number in range(150)]
    made = fmt("a.pdsl", f"ComponentParams a {{\n{''.join(lines)}}};\n")
    assert made == f"ComponentParams a\n{{\n{''.join(f'    {one}' for one in lines)}}};\n"


def test_changes_are_small() -> None:
    text = "a\n{\n    states b,  c;\n\n\n    initial_state d;\n  end_state e;\n};"
    source = Source(Path("a.smdsl"), text)
    new = formatted(source, [])
    assert new == "a\n{\n    states b, c;\n\n    initial_state d;\n    end_state e;\n};\n"
    found = [(text[start:end], put) for start, end, put in changes(source, new)]
    assert found == [(" ", ""), ("\n", ""), ("", "  "), ("", "\n")]

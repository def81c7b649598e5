"""`format_source`: rejected input, and kept properties of files."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.format.formatter import CannotFormat, changes, format_source
from robocomp_dsl.source import Source
from tests.format.formats import fmt, parse


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
def test_format_source_returns_none_for_syntax_errors(name: str, text: str) -> None:
    assert fmt(name, text) is None


def test_format_source_rejects_unknown_suffix() -> None:
    with pytest.raises(KeyError):
        format_source(Source(Path("x.txt"), ""), [])


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
def test_format_source_uses_majority_line_ends(text: str, end: str) -> None:
    result = fmt("a.smdsl", text)
    assert result is not None
    assert result.replace(end, "").count("\n") == result.replace(end, "").count("\r") == 0
    assert result.endswith(f"}};{end}")


def test_format_source_accepts_upper_case_suffix() -> None:
    assert format_source(Source(Path("A.SMDSL"), "a{states b;};"), []) == "a { states b; };\n"


MANY = "".join(f"    int p{n}\n" for n in range(150))
"""More fields without a `;` than the parser has findings for one file."""


def test_format_source_rejects_too_much_legacy_syntax() -> None:
    text = f"module M {{ struct S\n{{\n{MANY}}}; }};\n"
    found = list(parse("a.idsl", text)[1])
    with pytest.raises(CannotFormat, match="too much legacy syntax; fix it first"):
        format_source(Source(Path("a.idsl"), text), found)


def test_format_source_accepts_harmless_legacy_syntax() -> None:
    lines = [f"p{number} int 1;;\n" for number in range(150)]
    result = fmt("a.pdsl", f"ComponentParams a {{\n{''.join(lines)}}};\n")
    assert result == f"ComponentParams a\n{{\n{''.join(f'    {line}' for line in lines)}}};\n"


def test_format_changes_are_minimal() -> None:
    text = "a\n{\n    states b,  c;\n\n\n    initial_state d;\n  end_state e;\n};"
    source = Source(Path("a.smdsl"), text)
    new = format_source(source, [])
    assert new == "a\n{\n    states b, c;\n\n    initial_state d;\n    end_state e;\n};\n"
    found = [(text[start:end], put) for start, end, put in changes(source, new)]
    assert found == [(" ", ""), ("\n", ""), ("", "  "), ("", "\n")]

"""The Pygments lexers: contexts of keywords, and lossless tokens of any text."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygments.token import Error

from robocomp_dsl.highlight import pygments as lexers
from robocomp_dsl.highlight.table import LANGUAGES

ROOT = Path(__file__).parents[2]
FILES = [
    file
    for folder in ("interfaces", "components", "tests/cases", "tests/golden")
    for language in LANGUAGES
    for file in sorted((ROOT / folder).rglob(f"*.{language}"))
]
ALL = {language: getattr(lexers, f"{language.capitalize()}Lexer") for language in LANGUAGES}
assert len(FILES) > 100

CASES = [
    ("cdsl", "Component keeper {};", "Keyword.Declaration Name.Class"),
    ("cdsl", "component Component {};", "Keyword.Declaration Name.Class"),
    ("cdsl", "requires Component as requires;", "Keyword Name Keyword.Reserved Name"),
    ("cdsl", "LANGUAGE python;", "Keyword Name.Constant"),
    ("cdsl", "language Rust;", "Keyword Name"),
    ("cdsl", "gui Qt(QWidget);", "Keyword Name.Constant Name.Constant"),
    ("cdsl", 'statemachine "a.smdsl" visual;', "Keyword Literal.String Keyword.Reserved"),
    ("cdsl", "useQt qt4;", "Keyword.Pseudo Name"),
    ("idsl", "[command] void stop();", "Name.Decorator Keyword.Type Name.Function"),
    ("idsl", "float volume [dB];", "Keyword.Type Name Name.Attribute"),
    ("idsl", "bool module = false;", "Keyword.Type Name Operator Keyword.Constant"),
    ("idsl", "Module struct;", "Name Name"),
    ("idsl", "enum Mood { module, out };", "Keyword.Declaration Name.Class Name Name"),
    (
        "idsl",
        "int say(Req out, out float d) throws No;",
        "Keyword.Type Name.Function Name Name Keyword.Reserved Keyword.Type Name"
        " Keyword.Reserved Name",
    ),
    ("idsl", "int a; // struct B {", "Keyword.Type Name Comment"),
    ("idsl", "#include <struct>", "Comment"),
    ("pdsl", "string string live;", "Name.Variable Keyword.Type Keyword.Reserved"),
    (
        "pdsl",
        "rate float 50 [Hz] 1:1000;",
        "Name.Variable Keyword.Type Literal.Number Name.Attribute"
        " Literal.Number Operator Literal.Number",
    ),
    ("pdsl", "mode {int, live} live;", "Name.Variable Name.Constant Keyword.Reserved"),
    (
        "pdsl",
        "a int 1; b int 2;",
        "Name.Variable Keyword.Type Literal.Number" * 1
        + " Name.Variable Keyword.Type Literal.Number",
    ),
    ("ddsl", "component a on robot {};", "Keyword.Declaration Name.Class Keyword.Reserved Name"),
    (
        "ddsl",
        "connect a.on -> b.from { depth 1; };",
        "Keyword.Declaration Name Operator Name Operator Name Operator Name Keyword Literal.Number",
    ),
    ("ddsl", "set port = true;", "Keyword Name Operator Keyword.Constant"),
    (
        "ddsl",
        "restart on-failure max 5 in 60 s;",
        "Keyword Name.Constant Keyword.Reserved Literal.Number Keyword.Reserved"
        " Literal.Number Name.Attribute",
    ),
    (
        "smdsl",
        "on => over on after after 2 min;",
        "Name Operator Name Keyword.Reserved Name Keyword.Reserved Literal.Number Name.Attribute",
    ),
    ("smdsl", "transition { };", "Keyword.Pseudo"),
    ("smdsl", ":playing parallel { };", "Operator Name Keyword.Reserved"),
    (
        "bdsl",
        'input rate : double[] [deg] over yarp at "/rate";',
        "Keyword.Declaration Name.Class Operator Keyword.Type Literal.Number Name.Attribute"
        " Keyword.Reserved Name Keyword.Reserved Literal.String",
    ),
    ("bdsl", "rate 50 Hz;", "Keyword Literal.Number Name.Attribute"),
    ("bdsl", "rate = now;", "Name Operator Keyword.Constant"),
    ("bdsl", "item.call[0] = 1;", "Name Operator Name Literal.Number Operator Literal.Number"),
    (
        "bdsl",
        "x = mirror(a[0,1]) * 2 to [rad];",
        "Name Operator Name.Function Name Literal.Number Operator Literal.Number Keyword.Reserved"
        " Name.Attribute",
    ),
    (
        "bdsl",
        "policy synchronised within 20 ms;",
        "Keyword Name.Constant Keyword.Reserved Literal.Number Name.Attribute",
    ),
]


def kinds(language: str, text: str) -> str:
    found = [str(kind).removeprefix("Token.") for kind, _ in _visible(language, text)]
    return " ".join(kind for kind in found if kind != "Punctuation")


def _visible(language: str, text: str) -> list[tuple[object, str]]:
    return [(kind, part) for kind, part in ALL[language]().get_tokens(text) if part.strip()]


@pytest.mark.parametrize(("language", "text", "expected"), CASES)
def test_lexer_marks_keywords_as_the_grammar_does(language: str, text: str, expected: str) -> None:
    assert kinds(language, text) == expected


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_lexer_round_trip_of_every_file(file: Path) -> None:
    text = file.read_text(encoding="utf-8", errors="replace")
    lexer = ALL[file.suffix[1:]](stripnl=False, ensurenl=False)
    found = list(lexer.get_tokens(text))
    assert "".join(part for _, part in found) == text.replace("\r\n", "\n").replace(
        "\r", "\n"
    ).lstrip("\ufeff")
    assert not [part for kind, part in found if kind is Error]


@pytest.mark.parametrize("language", LANGUAGES)
def test_lexers_are_registered_by_name_and_file(language: str) -> None:
    from pygments.lexers import get_lexer_by_name, get_lexer_for_filename  # noqa: PLC0415

    assert isinstance(get_lexer_by_name(language), ALL[language])
    assert isinstance(get_lexer_for_filename(f"x.{language}"), ALL[language])


@given(st.sampled_from(LANGUAGES), st.text(alphabet='ab01 \n{};:[]()<>="/*#\\.,->on', max_size=60))
def test_lexer_round_trip_of_any_text(language: str, text: str) -> None:
    found = ALL[language](stripnl=False, ensurenl=False).get_tokens(text)
    assert "".join(part for _, part in found) == text

"""Properties of the formatter: it keeps meaning and comments, and is idempotent."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.format.formatter import PARSERS, changes
from robocomp_dsl.source import Source
from tests.format.formats import CASES, ROOT, fmt, parse

TEXT = r"\"(?:[^\"\\\n]|\\.)*\""
LINE_END = re.compile(r"(?: |\\t|\\r)+(?=\\n)")
COMMENT = re.compile(TEXT + r"|(<!--.*?-->|/\*.*?\*/|//[^\n]*|#[^\n]*)", re.DOTALL)


def _described(*folders: str) -> list[Path]:
    found = (path for folder in folders for path in (ROOT / folder).rglob("*"))
    texts = (path for path in found if path.name != "Latin1.idsl")  # which is no text
    return sorted(path for path in texts if path.suffix in PARSERS and path.is_file())


SHIPPED = [
    path
    for path in _described("interfaces", "components")
    if b"<mujoco" not in path.read_bytes()  # MuJoCo writes these as it likes
]
WRITTEN = _described("interfaces", "components", "tests/cases", "tests/format/cases")


def _comments(text: str) -> list[str]:
    """The text of all comments, lines stripped."""
    found = (match[1] for match in COMMENT.finditer(text) if match[1])
    return ["\n".join(line.strip() for line in item.split("\n")) for item in found]


def _stays(name: str, text: str, result: str) -> None:
    """Assert that `result` has the meaning of `text` and is already formatted."""
    (old, before), (new, after) = parse(name, text), parse(name, result)
    # Trees without their spans; the ends of lines in doc comments are those of the file then.
    assert LINE_END.sub("", repr(new)) == LINE_END.sub("", repr(old))
    assert [item.code.id for item in after.sorted()] == [item.code.id for item in before.sorted()]
    assert fmt(name, result) == result
    patched = text
    source = Source(Path(name), text)
    for start, end, put in reversed(changes(source, result)):
        patched = patched[:start] + put + patched[end:]
    assert patched == result


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: str(path.relative_to(ROOT)))
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["lf", "crlf"])
def test_formatter_is_idempotent_on_files(path: Path, end: str) -> None:
    text = Source.read(path).text.replace("\r\n", "\n").replace("\n", end)
    result = fmt(path.name, text)
    if result is None:
        assert parse(path.name, text)[1].has_errors
        return
    _stays(path.name, text, result)
    assert _comments(result.replace("\r", "")) == _comments(text.replace("\r", ""))
    assert result.endswith(end)
    assert not result.endswith(end * 2)
    assert not result.startswith(end)
    assert end * 3 not in result
    assert result.count("\r\n") == (result.count("\n") if end == "\r\n" else 0)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: str(path.relative_to(ROOT)))
def test_shipped_files_are_in_canonical_style(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert fmt(path.name, text) == text


@pytest.mark.parametrize("path", sorted(CASES.glob("*.out")), ids=lambda path: path.name)
def test_formatter_removes_trailing_whitespace_and_tabs(path: Path) -> None:
    inside_comment = {"comments.cdsl.out": ["\t*/"], "legacy.cdsl.out": ["\t\t    line */"]}
    lines = path.read_text(encoding="utf-8").split("\n")
    odd = [line for line in lines if line.startswith("\t") or line != line.rstrip()]
    assert odd == inside_comment.get(path.name, [])


TOKEN = re.compile(TEXT + r"|on-failure|\[[^\]\n]*\]|[+-]?[\w.]+|::|->|=>|[^\s\w]")
WORLD = [
    *('<?xml version="1.0"?>', "<!DOCTYPE innerModel>", "<innerModel", 'a="1"', ">"),
    *("<transform", 'id="a"', "tx='1'", ">", "<mesh", 'id="b  c"', "/>", "<mesh", 'id="d"', ">"),
    *("</mesh>", "<?keep this?>", "some  words", "</transform>", "<![CDATA[ <a> ]]>", "<t", ">"),
    *("words", "</t>", "<t", ">", "<![CDATA[x]]>", "</t>", "<plane", 'file="x/y.osg"', "/>"),
    "</innerModel>",
]
BLANKS = ["", " ", "  ", "\n", "\n\n", "\n\n\n\n", "\t", "\n\t ", " \n   "]
INLINE = ["/* b */", "/** d */", "/*\n  * s\n*/", "/* a\n b\n   c */", "/**/"]
TO_END = ["// l\n", "/// d\n", "# h\n", "//\n", "# h\n\n   #i\n", "//// x  \n"]
XML_COMMENTS = ["<!-- c -->", "<!--a\n  b-->"]
STRETCH = 40
"""Tokens between which there is something odd; between all others is a blank."""

TEXTS = {
    path.name: path.read_text(encoding="utf-8")
    for path in [
        *(ROOT / "components").rglob("*.?dsl"),
        ROOT / "interfaces" / "ControlBoard.idsl",
        ROOT / "tests" / "cases" / "smdsl" / "sem_clean.smdsl",
        ROOT / "tests" / "cases" / "pdsl" / "sem_clean.pdsl",
        ROOT / "tests" / "cases" / "idsl" / "sem_clean.idsl",
        ROOT / "tests" / "cases" / "bdsl" / "syntax_clean.bdsl",
    ]
}

DAMAGED = TEXTS | {
    path.name: path.read_text(encoding="utf-8") for path in CASES.iterdir() if path.suffix != ".out"
}


def _tokens(text: str) -> list[str]:
    bare = COMMENT.sub(lambda match: " " if match[1] else match[0], text)
    return TOKEN.findall(bare)


def _gap(chance: Random, comments: Sequence[str]) -> str:
    gap = chance.choice(BLANKS)
    if comments and chance.random() < 0.5:
        gap += chance.choice(comments) + chance.choice(BLANKS)
    return gap


def _reflowed(name: str, chance: Random) -> str:
    """The tokens of a file with random whitespace and comments between them."""
    tokens = _tokens(TEXTS[name])
    first = chance.randrange(len(tokens))
    text, left = "", ";"
    for number, token in enumerate(tokens):
        odd = first <= number < first + STRETCH
        gap = _gap(chance, INLINE + TO_END) if odd else " "
        if not (gap or left in ";{}(),<>" or token in "{}(),<>;"):
            gap = " "
        text, left = text + gap + token, token
    return text


@given(st.sampled_from(sorted(TEXTS)), st.integers(0, 2**32))
@settings(max_examples=150)
def test_formatter_accepts_any_whitespace_and_comments(name: str, seed: int) -> None:
    text = _reflowed(name, Random(seed))
    result = fmt(name, text)
    assert result is not None, [item.message for item in parse(name, text)[1]]
    _stays(name, text, result)
    assert _comments(result) == _comments(text)


@given(st.sampled_from(sorted(TEXTS)), st.integers(0, 2**32))
@settings(max_examples=60)
def test_formatter_ignores_spaces_within_lines(name: str, seed: int) -> None:
    neat = fmt(name, TEXTS[name])
    assert neat is not None
    chance = Random(seed)
    lines = []
    for line in neat.split("\n"):
        if any(mark in line for mark in ("//", "*", '"', "#", "[")):
            lines.append(line)
            continue
        between = r"(?<=\w) (?=\w)|(?<=[,;{]) "
        wide = re.sub(between, lambda _: chance.choice([" ", "  ", "\t"]), line.strip())
        lines.append(chance.choice(["", "\t", "   "]) + wide)
    assert fmt(name, "\n".join(lines)) == neat


@given(st.integers(0, 2**32))
@settings(max_examples=150)
def test_formatter_accepts_any_whitespace_and_comments_in_xml(seed: int) -> None:
    chance = Random(seed)
    text = ""
    for token in WORLD:
        gap = _gap(chance, XML_COMMENTS if token[0] == "<" else ()) if text else ""
        text += (gap or " " * bool(text)) + token
    result = fmt("world.xml", text)
    assert result is not None, [item.message for item in parse("world.xml", text)[1]]
    _stays("world.xml", text, result)
    assert _comments(result) == _comments(text)


DAMAGE = [
    "",
    "",
    ";",
    ";;",
    ";\n;",
    "\n",
    "// c\n",
    "/* c */",
    "# h\n",
    ", ",
    "}",
    "};",
    "\r\n",
    "x",
]


@given(st.sampled_from(sorted(DAMAGED)), st.integers(0, 2**32))
@settings(max_examples=300)
def test_formatter_of_damaged_and_legacy_texts(name: str, seed: int) -> None:
    """Random damage gives an error, or text that the formatter keeps."""
    chance = Random(seed)
    text = DAMAGED[name]
    for _ in range(chance.randint(1, 6)):
        ends = [match.start() for match in re.finditer("[;}]", text)] or [0]
        at = chance.choice(ends) if chance.random() < 0.7 else chance.randrange(len(text))
        text = text[:at] + chance.choice(DAMAGE) + text[at + chance.randint(0, 1) :]
    result = fmt(name, text)
    if result is not None:
        _stays(name, text, result)


@given(
    st.sampled_from(sorted(PARSERS)), st.text("ab1 \n\t{};,:()<>[]=\"'/*#.+-&!?é\r", max_size=60)
)
@settings(max_examples=300)
def test_formatter_accepts_any_text(suffix: str, text: str) -> None:
    result = fmt(f"x{suffix}", text)
    if result is not None:
        assert fmt(f"x{suffix}", result) == result
        old, new = (PARSERS[suffix](Source(Path("x"), t), Report()) for t in (text, result))
        assert repr(old) == repr(new)

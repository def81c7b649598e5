"""For any text a parser ends, with a tree and findings within the text."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import MAX_BYTES, Source, UnreadableSource, decode
from robocomp_dsl.syntax.parse import LANGUAGES, parse_innermodel

ROOT = Path(__file__).parents[2]
PARSERS = {**LANGUAGES, ".xml": parse_innermodel}
REAL = {
    suffix: sorted(
        p
        for folder in ("interfaces", "components", "tests/cases")
        for p in (ROOT / folder).rglob(f"*{suffix}")
    )
    for suffix in PARSERS
}
HEADS = {
    ".idsl": "module M {\n",
    ".cdsl": "Component C {\n",
    ".pdsl": "ComponentParams P {\n",
    ".ddsl": "Deployment D {\n",
    ".bdsl": "Bridge B { output o {\n",
}
PIECES = [
    "{",
    "}",
    ";",
    ",",
    '"',
    "/*",
    "*/",
    "//",
    "<",
    ">",
    "::",
    "->",
    "=>",
    "[",
    "]",
    "(",
    ")",
    "=",
    "#",
    "é",
    "🤖",
    "\\",
    "'",
    "0x",
    "1e999",
    "-",
    "import",
]
PIECES += ["\n", "\t", "<<<<<<< x\n"]


def parse_and_validate(suffix: str, text: str) -> Report:
    report = Report()
    tree = PARSERS[suffix](Source(Path(f"x{suffix}"), text), report)
    assert tree is not None
    for diagnostic in report:
        for span in (diagnostic.span, *(n.span for n in diagnostic.notes)):
            assert 0 <= span.start <= span.end <= len(text)
            assert span.start_position <= span.end_position
        for edit in diagnostic.fix.edits if diagnostic.fix else ():
            assert 0 <= edit.span.start <= edit.span.end <= len(text)
    return report


def mutate(text: str, rng: random.Random) -> str:
    for _ in range(rng.randint(1, 6)):
        a, b = sorted((rng.randint(0, len(text)), rng.randint(0, len(text))))
        b = min(b, a + rng.choice((1, 1, 5, 60)))
        match rng.randint(0, 4):
            case 0:
                text = text[:a] + text[b:]
            case 1:
                text = text[:a] + rng.choice(PIECES) + text[a:]
            case 2:
                text = text[:b] + text[a:b] + text[b:]
            case 3:
                text = text[:a] + text[a:b].swapcase() + text[b:]
            case 4:
                text = text[:a] + text[a:b][::-1] + text[b:]
    return text


@pytest.mark.parametrize("suffix", sorted(PARSERS))
@settings(max_examples=150, suppress_health_check=list(HealthCheck))
@given(seed=st.integers(0, 2**32))
def test_parser_accepts_mutated_files(suffix: str, seed: int) -> None:
    rng = random.Random(seed)
    files = REAL[suffix]
    text = (
        rng.choice(files).read_text(errors="replace")
        if files
        else '<innerModel><transform id="a"/></innerModel>'
    )
    parse_and_validate(suffix, mutate(text, rng))


@pytest.mark.parametrize("suffix", sorted(PARSERS))
@settings(max_examples=100)
@given(text=st.text(max_size=300))
def test_parser_accepts_any_text(suffix: str, text: str) -> None:
    parse_and_validate(suffix, text)


@pytest.mark.parametrize("suffix", sorted(PARSERS))
@pytest.mark.parametrize(
    "piece", ["{", "}", ";", "(", '"', "/*", "a ", "a{", "<a>", "struct s {", "\n", "é", "#"]
)
def test_parser_bounds_time_for_long_repetition(suffix: str, piece: str) -> None:
    # Lark reads a million tags in half a minute; a tenth of them show the same.
    size = MAX_BYTES // 10 if suffix == ".xml" else MAX_BYTES
    count = size // len(piece.encode())
    assert len(parse_and_validate(suffix, piece * count)) <= 210


@pytest.mark.parametrize("suffix", sorted(LANGUAGES))
@pytest.mark.parametrize("piece", ["[", "-", "€ ", "<", "/*", "<!--", "("])
def test_recovery_ends_for_invalid_block_content(suffix: str, piece: str) -> None:
    # The end of the file has to be reached even after the parser gave up.
    head = HEADS.get(suffix, "M {\n")
    assert 1 <= len(parse_and_validate(suffix, head + piece * 2000)) <= 210


@pytest.mark.parametrize("suffix", sorted(PARSERS))
def test_parser_reports_empty_file(suffix: str) -> None:
    assert [diagnostic.code.id for diagnostic in parse_and_validate(suffix, "")]


@pytest.mark.parametrize(
    "data", [b"\0\1\2", b"\xff\xfe\0m", b"module \xe9", b"x" * (MAX_BYTES + 1)]
)
def test_source_reports_binary_data(data: bytes) -> None:
    with pytest.raises(UnreadableSource):
        decode(data)

"""`Finding`: one line for lists, several for terminals, and a span for reports."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Code, Report, Severity
from robocomp_dsl.finding import NOWHERE, Finding, Location, SourceText
from robocomp_dsl.source import Source

TEXT = "parts:\n  - gain: 90 deg\n\n"
CODE = Code("RC000", Severity.ERROR, "a title", "an explanation")


def text() -> SourceText:
    return SourceText.of_text("r.yaml", TEXT)


@pytest.mark.parametrize(
    ("location", "expected"),
    [
        (NOWHERE, "wrong (do it)"),
        (Location(SourceText(""), 3), "line 3: wrong (do it)"),
        (Location(text()), "r.yaml: wrong (do it)"),
        (Location(text(), 2), "r.yaml:2: wrong (do it)"),
        (Location(text(), 2, 5), "r.yaml:2:5: wrong (do it)"),
    ],
)
def test_finding_in_one_line(location: Location, expected: str) -> None:
    assert str(Finding(location, "wrong", help="do it")) == expected


def test_finding_rendered_with_excerpt_and_carets() -> None:
    finding = Finding(text().word_at(2, 5), "wrong", "a label", "do it")
    assert finding.render("warning").splitlines() == [
        "warning: wrong",
        "  --> r.yaml:2:5",
        "   |",
        " 2 |   - gain: 90 deg",
        "   |     ^^^^ a label",
        "help: do it",
    ]


def test_finding_rendered_without_location() -> None:
    assert Finding(NOWHERE, "wrong", "a label").render("") == "wrong\nnote: a label"


def test_long_line_is_cut_around_the_carets() -> None:
    line = "x" * 500
    rendered = Finding(Location(SourceText("f", (line,)), 1, 300, 4), "wrong").render()
    shown, carets = rendered.splitlines()[3:]
    assert len(shown) <= 170
    assert carets.count("^") == 4


@pytest.mark.parametrize(
    ("line", "column", "word"),
    [(2, 5, "gain"), (2, 11, "90"), (2, 3, "- gain: 90 deg"[:1]), (1, 6, ":")],
)
def test_word_at_and_span_at_agree(line: int, column: int, word: str) -> None:
    source, report = Source(Path("r.yaml"), TEXT), Report()
    report.add_finding(CODE, Finding(text().word_at(line, column), "wrong"), source)
    (diagnostic,) = report
    assert diagnostic.span.text == word


@pytest.mark.parametrize(
    ("line", "column", "width", "expected"),
    [
        (0, 0, 0, (0, 0)),
        (2, 0, 0, (9, 23)),  # the line without its blanks
        (2, 5, 4, (11, 15)),
        (2, 90, 4, (25, 25)),
        (9, 1, 1, (25, 25)),  # after the end
    ],
)
def test_source_span_at(line: int, column: int, width: int, expected: tuple[int, int]) -> None:
    span = Source(Path("r.yaml"), TEXT).span_at(line, column, width)
    assert (span.start, span.end) == expected

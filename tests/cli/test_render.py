"""Findings on a terminal."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.cli.output import render
from robocomp_dsl.diagnostics import Code, Diagnostic, Note, Severity
from robocomp_dsl.source import Source

UNKNOWN = Code("RC204", Severity.ERROR, "", "")
LEGACY = Code("RC101", Severity.WARNING, "", "")


def span(text: str, path: str = "robot.cdsl"):  # type: ignore[no-untyped-def]
    """The part of `text` between the signs « and »."""
    start, end = text.index("«"), text.index("»") - 1
    return Source(Path(path), text.replace("«", "").replace("»", "")).span(start, end)


def shown(text: str, label: str = "") -> str:
    """The excerpt alone."""
    diagnostic = Diagnostic(UNKNOWN, span(text), "m", label)
    return render.full([diagnostic]).partition("\n")[2]


def test_render_matches_design() -> None:
    text = "\n" * 6 + "        requires «Lasr», DifferentialRobot;\n"
    diagnostic = Diagnostic(
        UNKNOWN,
        span(text),
        "interface `Lasr` is not declared by any import",
        label="did you mean `Laser`?",
        help="Laser is declared in interfaces/Laser.idsl",
    )
    assert render.full([diagnostic]) == (
        "error[RC204]: interface `Lasr` is not declared by any import\n"
        "  --> robot.cdsl:7:18\n"
        "   |\n"
        " 7 |         requires Lasr, DifferentialRobot;\n"
        "   |                  ^^^^ did you mean `Laser`?\n"
        "help: Laser is declared in interfaces/Laser.idsl\n"
    )


def test_render_notes_in_other_files() -> None:
    text = "\n" * 99 + "a «b» c\n"
    diagnostic = Diagnostic(
        UNKNOWN, span(text), "first", notes=(Note(span("x\n«y»", "lib/L.idsl"), "seen here"),)
    )
    two = Diagnostic(LEGACY, span("«»"), "second")
    assert render.full([diagnostic, two]) == (
        "error[RC204]: first\n"
        "    --> robot.cdsl:100:3\n"
        "     |\n"
        " 100 | a b c\n"
        "     |   ^\n"
        "note: seen here\n"
        "  --> lib/L.idsl:2:1\n"
        "   |\n"
        " 2 | y\n"
        "   | ^\n"
        "\n"
        "warning[RC101]: second\n"
        "  --> robot.cdsl:1:1\n"
    )


EXCERPTS = {
    "tabs": (
        "\t\ta\t«b»",
        "  --> robot.cdsl:1:5\n   |\n 1 |         a   b\n   |             ^ L\n",
    ),
    "wide": (
        "/* 机器人 */ «x»",
        "  --> robot.cdsl:1:11\n   |\n 1 | /* 机器人 */ x\n   |              ^ L\n",
    ),
    "wide inside": ("a «机器» b", "  --> robot.cdsl:1:3\n   |\n 1 | a 机器 b\n   |   ^^^^ L\n"),
    "combining": ("e\u0301 «x»", "  --> robot.cdsl:1:4\n   |\n 1 | e\u0301 x\n   |   ^ L\n"),
    "control": ("\x1b[31m «x»", "  --> robot.cdsl:1:7\n   |\n 1 | \ufffd[31m x\n   |       ^ L\n"),
    "end of line": ("abc«»\nd", "  --> robot.cdsl:1:4\n   |\n 1 | abc\n   |    ^ L\n"),
    "end of file": ("abc\n«»", "  --> robot.cdsl:2:1\n   |\n 2 |\n   | ^ L\n"),
    "line end": ("abc«\n»d", "  --> robot.cdsl:1:4\n   |\n 1 | abc\n   |    ^ L\n"),
    "crlf": ("a «b» c\r\nd", "  --> robot.cdsl:1:3\n   |\n 1 | a b c\n   |   ^ L\n"),
    "two lines": (
        "a «b\n   c» d",
        "  --> robot.cdsl:1:3\n   |\n 1 | a b\n   |   ^\n 2 |    c d\n   |    ^ L\n",
    ),
    "empty line": (
        "«a\n\t\n{»",
        "  --> robot.cdsl:1:1\n   |\n 1 | a\n   | ^\n 3 | {\n   | ^ L\n",
    ),
    "old Mac": ("a\rb «c»", "  --> robot.cdsl:2:3\n   |\n 2 | b c\n   |   ^ L\n"),
    "many lines": (
        "«1\n2\n3\n4\n5\n6\n7»",
        (
            "  --> robot.cdsl:1:1\n   |\n 1 | 1\n   | ^\n 2 | 2\n   | ^\n 3 | 3\n   | ^\n...\n"
            " 7 | 7\n   | ^ L\n"
        ),
    ),
}


@pytest.mark.parametrize("case", EXCERPTS)
def test_render_excerpt(case: str) -> None:
    text, expected = EXCERPTS[case]
    assert shown(text, "L") == expected


def test_render_cuts_long_line_around_carets() -> None:
    lines = shown("x" * 5000 + "«bad»" + "y" * 5000).splitlines()
    assert all(len(line) <= render.MAX_EXCERPT_COLUMNS + 10 for line in lines)
    at = lines[-1].index("^^^")
    assert lines[-2][at : at + 3] == "bad"


def test_render_colours_do_not_change_text() -> None:
    diagnostic = Diagnostic(UNKNOWN, span("a «b»"), "m", "label", help="h")
    coloured = render.full([diagnostic], colours=True)
    assert "\x1b[1;31m" in coloured
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured) == render.full([diagnostic])


def test_render_strips_control_characters() -> None:
    text = "\x1b]0;x\x07«\x9b1m»\u202e"
    diagnostic = Diagnostic(
        UNKNOWN, span(text, "a\x1b[31m.cdsl"), "m\x1b[0m", "l\x07", help="h\x1b"
    )
    assert render.full([diagnostic]).replace("\n", "").isprintable()

"""Bottle definitions as trees: items, nested lists, comments; any text is accepted."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.parse import parse_bottle

GAZE = """\
# Where a head looks.
# Sent at 50 Hz.

# Positive to the left.
(double azimuth [deg])  # of the eyes
(target (int x [px]) (int y))
(points * (float64 x [m]))
(string names …)
(blob raw)
"""


def declarations(text: str) -> dict[str, ast.Declaration]:
    report = Report()
    file = parse_bottle(Source(Path("gaze.bottle"), text), report)
    assert not list(report), [finding.message for finding in report]
    assert file.modules[0].name.text == "gaze"
    return {each.name.text: each for each in file.modules[0].declarations}


def test_file_is_a_struct_with_the_items_in_order() -> None:
    gaze = declarations(GAZE)["gaze"]
    assert isinstance(gaze, ast.Struct)
    assert gaze.doc == "Where a head looks.\nSent at 50 Hz."
    assert [(f.name.text, f.type.text, bool(f.array)) for f in gaze.fields] == [
        ("azimuth", "float64", False),
        ("target", "gaze_target", False),
        ("points", "gaze_points", True),
        ("names", "string", True),
        ("raw", "Blob", False),
    ]
    azimuth = gaze.fields[0]
    assert azimuth.unit
    assert (azimuth.unit.text, azimuth.doc) == ("deg", "Positive to the left.\nof the eyes")


def test_nested_list_is_a_struct() -> None:
    target = declarations(GAZE)["gaze_target"]
    assert isinstance(target, ast.Struct)
    assert [(f.name.text, f.unit.text if f.unit else "") for f in target.fields] == [
        ("x", "px"),
        ("y", ""),
    ]


def test_one_repeated_item_without_name_is_a_sequence() -> None:
    gaze = declarations("# Angles.\n\n(float64 * [deg])\n")["gaze"]
    assert isinstance(gaze, ast.Sequence)
    assert (gaze.element.text, gaze.doc) == ("float64", "Angles.\n[deg]")


WORDS = st.sampled_from(
    ["(", ")", "*", "…", "...", "[m]", "[", "]", "int32", "x", "#", "\n", "\n\n", "blob", "é", "1",
     "(" * 60, "(int32 x)", "(a (int8 b))", '"', "string"]
) | st.text(max_size=8)  # fmt: skip


@given(st.lists(WORDS, max_size=14).map(" ".join))
def test_any_text_is_read_as_bottle_definition(text: str) -> None:
    report = Report()
    source = Source(Path("any.bottle"), text)
    file = parse_bottle(source, report)
    assert file.complete is not report.has_errors
    for finding in report:
        assert finding.span.source is source
        assert 0 <= finding.span.start <= finding.span.end <= len(text)

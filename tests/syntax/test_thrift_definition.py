"""Thrift definitions as trees: declarations, comments, units, containers; any text is accepted."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.definitions import module_name
from robocomp_dsl.syntax.parse import parse_thrift

MOTOR = """\
/* A licence. */
namespace yarp demo
include "first/limits.thrift"

/**
 * What it measures.
 *   indented
 */
struct Status {
  /** Position of the joint. */
  1: double position = HALF,  // [deg]
  2: double velocity ; # in degrees per second
  3: list<list<i32>> table, 4: list<list<i32>> other
  /** Seconds since the start. */
  5: string text = "it's // no comment"  // plain
  6: limits.Limits limits = limits.DEFAULT
}
const double HALF = 0x10
service Motor extends limits.Base {
  /** Moves. @param angle the target [rad] @param name in seconds */
  oneway void move(1: double angle, 2: string name = "x");
  map<string, limits.Limits> all() throws (1: limits.Failed failed)
}
"""


def file_of(text: str, name: str = "motor.thrift") -> ast.File:
    report = Report()
    file = parse_thrift(Source(Path(name), text), report)
    assert not list(report), [finding.message for finding in report]
    assert file.complete
    return file


def declarations(text: str) -> dict[str, ast.Declaration]:
    return {each.name.text: each for each in file_of(text).modules[0].declarations}


def struct_of(text: str, name: str = "Status") -> ast.Struct:
    struct = declarations(text)[name]
    assert isinstance(struct, ast.Struct)
    return struct


def test_struct_has_documentation_and_units_of_its_comments() -> None:
    struct = struct_of(MOTOR.replace("= HALF", ""))
    assert struct.doc == "What it measures.\n  indented"
    found = {f.name.text: (f.unit.text if f.unit else "", f.doc) for f in struct.fields}
    assert found == {
        "position": ("deg", "Position of the joint."),
        "velocity": ("deg/s", "in degrees per second"),
        "table": ("", ""),
        "other": ("", ""),
        "text": ("", "Seconds since the start.\nplain"),
        "limits": ("", ""),
    }


def test_fields_have_types_and_defaults() -> None:
    fields = struct_of(MOTOR).fields
    assert [field.type.text for field in fields] == [
        "float64", "float64", "ListOfListOfInt32", "ListOfListOfInt32", "string", "limits::Limits",
    ]  # fmt: skip
    defaults = [getattr(field.default, "value", None) for field in fields]
    assert defaults == [None, None, None, None, "it's // no comment", None]
    assert [getattr(field.default, "text", None) for field in fields][5] == "DEFAULT"


def test_constant_of_the_file_is_a_default() -> None:
    text = "const i32 SIZE = -7\nstruct Status { 1: i32 size = SIZE }\n"
    (field,) = struct_of(text).fields
    assert getattr(field.default, "value", None) == -7
    assert field.default
    assert field.default.span.text == "SIZE"
    (constant,) = struct_of(text, "Constants").constants
    assert (constant.name.text, getattr(constant.value, "value", None)) == ("SIZE", -7)


def test_container_is_declared_once_where_it_is_first_used() -> None:
    found = declarations(MOTOR)
    implicit = [name for name, each in found.items() if getattr(each, "is_implicit", False)]
    assert implicit == ["ListOfInt32", "ListOfListOfInt32", "MapOfStringToLimits"]
    inner = found["ListOfInt32"]
    assert inner.name.span.text == "list"
    assert inner.span.text == "list<i32>"
    assert inner.span.start_position[0] == 13


def test_container_has_no_name_that_the_file_declares() -> None:
    text = "struct ListOfBool { 1: list<bool> flags }\n"
    (field,) = struct_of(text, "ListOfBool").fields
    assert field.type.text == "ListOfBool_"


def test_service_has_operations_with_patterns_units_and_exceptions() -> None:
    motor = declarations(MOTOR)["Motor"]
    assert isinstance(motor, ast.Interface)
    assert motor.base
    assert motor.base.text == "limits::Base"
    move, everything = motor.operations
    assert move.pattern
    assert (move.pattern.text, move.result) == ("command", None)
    assert [(p.name.text, p.unit.text if p.unit else "") for p in move.params] == [
        ("angle", "rad"),
        ("name", "s"),  # a string has no unit: the check leaves it out
    ]
    assert everything.result
    assert everything.result.text == "MapOfStringToLimits"
    assert [exception.text for exception in everything.throws] == ["limits::Failed"]


def test_include_is_an_import() -> None:
    (statement,) = file_of(MOTOR).imports
    assert (statement.path.value, statement.span.start_position) == ("first/limits.thrift", (3, 1))


@pytest.mark.parametrize(
    ("file", "expected"),
    [("motor.thrift", "motor"), ("my-types.v2.thrift", "my_types_v2"), ("2d.thrift", "_2d")],
)
def test_module_name_is_that_of_the_file(file: str, expected: str) -> None:
    assert module_name(Path(file)) == expected
    assert file_of("struct S { }", file).modules[0].name.text == expected


WORDS = st.sampled_from(
    [
        *("struct S {", "}", "service S {", "enum E {", "union", "\n", "1:", "i32 x", "list<", ">"),
        *("map", "<", ",", ";", "(", ")", "= 1", "=", "[", "{", '"a', '"b"', "/*", "*/", "/**"),
        *("//", "#", "é", "void f()", "oneway", "throws", "extends", "const", "typedef"),
        *("include", "namespace", "a.b.c", "yarp.name", ".", "..", "a.", "9" * 5000, "1e999"),
        *("0x", "-", "optional", "\x00", "set<" * 50),
    ]
) | st.text(max_size=12)


@given(st.lists(WORDS, max_size=14).map(" ".join))
def test_any_text_is_read_as_thrift_definition(text: str) -> None:
    report = Report()
    source = Source(Path("any.thrift"), text)
    file = parse_thrift(source, report)
    assert file.complete is not report.has_errors
    for finding in report:
        assert finding.span.source is source
        assert 0 <= finding.span.start <= finding.span.end <= len(text)

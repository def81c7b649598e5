"""ROS definitions as trees: fields, constants, comments, positions; any text is accepted."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.parse import parse_ros
from robocomp_dsl.syntax.ros.definition import definition_name
from robocomp_dsl.syntax.ros.kinds import ROS_SUFFIXES

SCAN = """\
# Single scan.
#
# If you have another device, use another message.

std_msgs/Header header # timestamp of
                             # the first ray
                             #
                             # in frame frame_id

float32 angle_min            # start angle [rad]
# Above.
float32[<=4] ranges  # [m] (values outside are "invalid" # really)
string<=5[2] names ["a # b", 'c']  # Two.
char A = 5
string TEXT= it's so   # an apostrophe
string QUOTED="# no comment"
Point position
"""


def tree(text: str, path: str = "demo_msgs/msg/Scan.msg") -> ast.Module:
    report = Report()
    file = parse_ros(Source(Path(path), text), report)
    assert not list(report), [finding.message for finding in report]
    assert file.complete
    return file.modules[0]


def members(text: str) -> dict[str, ast.Field | ast.Constant]:
    (struct,) = tree(text).declarations
    assert isinstance(struct, ast.Struct)
    return {member.name.text: member for member in (*struct.fields, *struct.constants)}


def test_message_has_documentation_of_its_comments() -> None:
    (struct,) = tree(SCAN).declarations
    assert struct.doc == "Single scan.\n\nIf you have another device, use another message."
    found = {name: member.doc for name, member in members(SCAN).items()}
    assert found == {
        "header": "timestamp of\nthe first ray\n\nin frame frame_id",
        "angle_min": "start angle",
        "ranges": 'Above.\n[m] (values outside are "invalid" # really)',
        "names": "Two.",
        "A": "",
        "TEXT": "an apostrophe",
        "QUOTED": "",
        "position": "",
    }


def test_members_of_message_have_types_limits_and_values() -> None:
    found = members(SCAN)
    ranges, names = found["ranges"], found["names"]
    assert isinstance(ranges, ast.Field)
    assert isinstance(names, ast.Field)
    assert ranges.array
    assert (ranges.type.text, ranges.array.bound, ranges.array.size) == ("float32", 4, 0)
    assert ranges.unit
    assert ranges.unit.text == "m"
    assert names.array
    assert (names.string_bound, names.array.size) == (5, 2)
    assert [getattr(item, "value", None) for item in names.items] == ["a # b", "c"]
    values = {n: getattr(m.value, "value", None) for n, m in found.items()
              if isinstance(m, ast.Constant)}  # fmt: skip
    assert values == {"A": 5, "TEXT": "it's so", "QUOTED": "# no comment"}


def test_message_imports_the_types_of_its_fields() -> None:
    report = Report()
    file = parse_ros(Source(Path("demo_msgs/msg/Scan.msg"), SCAN), report)
    assert [(statement.path.value, statement.span.text) for statement in file.imports] == [
        ("std_msgs/msg/Header.msg", "std_msgs/Header"),
        ("demo_msgs/msg/Point.msg", "Point"),
    ]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("a/demo_msgs/msg/Scan.msg", ("demo_msgs", "msg", "Scan")),
        ("a/demo_msgs/Scan.msg", ("demo_msgs", "msg", "Scan")),
        ("demo_msgs/srv/Set.srv", ("demo_msgs", "srv", "Set")),
        ("demo_msgs/action/Move.action", ("demo_msgs", "action", "Move")),
    ],
)
def test_definition_name_is_that_of_its_path(path: str, expected: tuple[str, str, str]) -> None:
    assert definition_name(Path(path)) == expected


def test_service_and_action_have_a_struct_for_each_part() -> None:
    service = tree("# In.\n\nint32 a\n---\n# Out.\n\nint32 b\n", "demo_msgs/srv/Add.srv")
    structs = [each for each in service.declarations if isinstance(each, ast.Struct)]
    assert [(each.name.text, each.ros_name, each.doc) for each in structs] == [
        ("Add_Request", "demo_msgs/srv/Add_Request", "In."),
        ("Add_Response", "demo_msgs/srv/Add_Response", "Out."),
    ]
    action = tree("---\n---\n", "demo_msgs/action/Wait.action")
    assert [each.name.text for each in action.declarations] == [
        "Wait_Goal",
        "Wait_Result",
        "Wait_Feedback",
    ]


LINES = st.sampled_from(
    ["---", "#", "# [m]", "", "int32 x", "int32 x 5", "int32[] x [1, 2]", "string X='a", "Header h",
     "string<=0 x", "int32<=4 x", "int32[99999999] x", "uint8 X=" + "9" * 5000, "float64 x 1e999",
     "string<=" + "9" * 5000 + " x", "int32[<=] x", "bool x 1", "a/b/c/d e", "größe x", "x[",
     "int32[2] x [", "string[] x [\"a\\\"", "wstring[2] w", "int32 x;", "\t int32\tx\t#\t", "\x00"]
) | st.text(max_size=12)  # fmt: skip


@given(st.lists(LINES, max_size=8).map("\n".join), st.sampled_from(ROS_SUFFIXES))
def test_any_text_is_read_as_ros_definition(text: str, suffix: str) -> None:
    report = Report()
    source = Source(Path(f"demo_msgs/{suffix[1:]}/Any{suffix}"), text)
    file = parse_ros(source, report)
    assert file.complete is not report.has_errors
    for finding in report:
        assert finding.span.source is source
        assert 0 <= finding.span.start <= finding.span.end <= len(text)

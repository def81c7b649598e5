"""The syntax of InnerModel files: errors are located, and the rest is kept."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast.innermodel import Element, File
from robocomp_dsl.syntax.grammar import build_tables
from robocomp_dsl.syntax.parse import parse_innermodel
from robocomp_dsl.syntax.xml.xml_tokens import tokens


def parsed(text: str) -> tuple[File, Report]:
    report = Report()
    return parse_innermodel(Source(Path("w.xml"), text), report), report


def shape(element: Element | None) -> str:
    """`tag(attributes)[children]`."""
    if element is None:
        return "-"
    values = ",".join(f"{a.name.text}={a.value.value}" for a in element.attributes)
    inside = " ".join(map(shape, element.children))
    return f"{element.tag.text}({values})" + (f"[{inside}]" if inside else "")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("<innermodel/>", "innermodel()"),
        ('<?xml version="1.0"?>\n<InnerModel>\n</InnerModel>\n', "InnerModel()"),
        ("<a b = '1'\n\tc=\"2 3\"/>", "a(b=1,c=2 3)"),
        ("<a><b/><!-- <c/> --><d><e/></d></a>", "a()[b() d()[e()]]"),
        ('<a b="&lt;&amp;&gt;&quot;&apos;&#65;&#x42;"/>', "a(b=<&>\"'AB)"),
        ('<a b="x\ny"/>', "a(b=x\ny)"),
        ('<a b=""></a >', "a(b=)"),
        ('<a file="/x/y=z.osg"/>', "a(file=/x/y=z.osg)"),
    ],
)
def test_innermodel_parser_reads_valid_text(text: str, found: str) -> None:
    tree, report = parsed(text)
    assert [d.message for d in report] == []
    assert shape(tree.root) == found
    assert tree.complete


@pytest.mark.parametrize(
    ("text", "tree", "findings"),
    [
        ('<a x="1" y="2" x="3"/>', "a(x=1,y=2)", ['RC181 1:16 x="3"']),
        ('<a x="1" x="1"/>', "a(x=1)", ['RC186 1:10 x="1"']),
        ('<a tx="0 ty="0"><b/></a>', "a(tx=0,ty=0)[b()]", ['RC180 1:7 "0']),
        ("<a x=5/>", "a(x=5)", ["RC180 1:6 5"]),
        ("<a x/>", "a(x=)", ["RC180 1:4 x"]),
        ('<a x="1"y="2"/>', "a(x=1,y=2)", ["RC180 1:9 y"]),
        ('<a %$ x="1" />', "a(x=1)", ["RC180 1:4 %$"]),
        ('<a x="&nbsp;"/>', "a(x=&nbsp;)", ["RC180 1:7 &nbsp;"]),
        ('<a x="a & b"/>', "a(x=a & b)", ["RC180 1:9 &"]),
        ("<a <b/></a>", "a()[b()]", ["RC180 1:1 <a"]),
        ("<a><b></a>", "a()[b()]", ["RC182 1:5 b"]),
        ("<a><b>", "a()[b()]", ["RC182 1:2 a", "RC182 1:5 b"]),
        ("<a></b></a>", "a()", ["RC182 1:4 </b>"]),
        ("<a></A>", "a()", ["RC182 1:6 A"]),
        ("<joint></jiont><b/>", "joint()", ["RC182 1:10 jiont", "RC183 1:17 b"]),
        ("<a/><b/>", "a()", ["RC183 1:6 b"]),
        ("", "-", ["RC183 1:1 "]),
        ("hello", "-", ["RC183 1:1 ", "RC183 1:1 hello"]),
        ("<a>text<b/></a>", "a()[b()]", ["RC184 1:4 text"]),
        ("<a>1 < 2</a>", "a()", ["RC180 1:6 <", "RC184 1:4 1", "RC184 1:8 2"]),
        ("<a><!-- open", "a()", ["RC180 1:4 <!--", "RC182 1:2 a"]),
        (
            '<!DOCTYPE a [<!ENTITY b "c">]><a/>',
            "a()",
            ['RC185 1:1 <!DOCTYPE a [<!ENTITY b "c">]>'],
        ),
    ],
)
def test_innermodel_parser_reports_and_recovers(text: str, tree: str, findings: list[str]) -> None:
    found, report = parsed(text)
    assert shape(found.root) == tree
    message = [
        f"{d.code.id} {d.span.start_position[0]}:{d.span.start_position[1]} {d.span.text}"
        for d in report
    ]
    assert sorted(message) == sorted(findings)
    assert found.complete == (not report.has_errors)


def test_innermodel_parser_fixes_repair_text() -> None:
    text = '<a x=5 y="1"z="2" w="3"w="3" v="0><b></a>'
    for _ in range(10):
        fixes = [d.fix for d in parsed(text)[1].sorted() if d.fix]
        if not fixes:
            break
        (edit,) = fixes[0].edits
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    assert shape(parsed(text)[0].root) == "a(x=5,y=1,z=2,w=3,v=0)[b()]"


def test_innermodel_parser_limits_number_of_findings() -> None:
    _, report = parsed("<a " + "x='1' " * 1000 + ">" + "</q>" * 5000)
    assert 100 <= len(report) < 210  # 100 warnings, 100 errors


def test_innermodel_parser_accepts_deep_nesting() -> None:
    tree, report = parsed("<a>" * 20_000 + "</a>" * 20_000)
    assert not report.has_errors
    assert tree.root is not None


PIECES = [
    "<innermodel>", "</innermodel>", "<transform ", 'id="a" ', "tx='1'", ">", "/>", "<", "&", '"',
    "<!--", "-->", "<![CDATA[", "]]>", "<!DOCTYPE", "[", "<?x", "?>", "=", " ", "\n", "x", "é",
    "\x01",
]  # fmt: skip


@settings(max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=40).map("".join))
def test_innermodel_parser_accepts_any_text(text: str) -> None:
    tree, report = parsed(text)
    assert tree.complete == (not report.has_errors)
    for finding in report:
        assert 0 <= finding.span.start <= finding.span.end <= len(text)


@cache
def lark() -> Any:
    return build_tables.lark_parser(build_tables.XML)


@settings(max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=40).map("".join))
def test_xml_tokens_equal_those_of_lark(text: str) -> None:
    read = lark().parse_interactive(text).exhaust_lexer()
    expected = [(t.type, t.start_pos, t.end_pos) for t in read]
    assert [(t.kind, t.start, t.end) for t in tokens(text)] == expected


def test_innermodel_terminal_table_is_up_to_date() -> None:
    saved = json.loads((GRAMMARS / "tables" / "innermodel.json").read_text())
    assert saved == build_tables.build_xml_tables()

"""Keywords of BDSL are names wherever the grammar has no place for the keyword."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.languages.bdsl_expressions import operands
from robocomp_dsl.syntax.parse import parse_bdsl

WORDS = sorted(json.loads((GRAMMARS / "words.json").read_text())["bdsl"]["keywords"])
TEXT = """
Bridge {word}
{{
    middleware {word};
    input {word} : {word}::{word}.{word} over {word} at "x" {{ stamp {word}.{word}; }};
    function {word}({word}[] {word} [m]) -> {word};
    hub {word} = {word}, {word}.{word}[0];
    output {word} : {word} over {word} = {word}
    {{
        {word}.{word} = 1;
        x = {word}({word}) * {word};
    }};
    service {word} : {word} {{ call {word} : {word}.{word} {{ {word} = 1; }}; {word} = {word}; }};
}};
"""


@pytest.mark.parametrize("word", WORDS)
def test_bdsl_keyword_is_name_elsewhere(word: str) -> None:
    report = Report()
    file = parse_bdsl(Source(Path("x.bdsl"), TEXT.format(word=word)), report)
    assert [str(finding) for finding in report] == []
    assert file.bridge is not None
    (output,) = file.bridge.outputs
    assert len(output.fields) == 2


def expression(text: str) -> ast.Expression:
    report = Report()
    file = parse_bdsl(Source(Path("x.bdsl"), f"Bridge b {{ hub h = {text}; }};"), report)
    assert [str(finding) for finding in report] == []
    assert file.bridge is not None
    return file.bridge.hubs[0].values[0]


def shown(node: ast.Expression) -> str:
    """The expression with all parentheses, in prefix notation."""
    values = [shown(operand) for operand in operands(node)]
    match node:
        case ast.Operation(operator=operator):
            return f"({operator} {' '.join(values)})"
        case ast.Conversion(unit=unit):
            return f"(to {values[0]} {unit.text})"
        case ast.Member(name=name):
            return f"(. {values[0]} {name.text})"
        case ast.Selection(indices=indices, bounds=bounds):
            return f"(at {values[0]} {bounds or indices})"
        case ast.FunctionCall(name=name):
            return f"({' '.join([name.text, *values])})"
        case ast.NumberValue(value=number, unit=unit):
            return f"{number}[{unit.text}]" if unit else str(number)
    return _simple(node, values)


def _simple(node: ast.Expression, values: list[str]) -> str:
    match node:
        case ast.Negation():
            return f"(- {values[0]})"
        case ast.ListValue():
            return f"{{{', '.join(values)}}}"
        case ast.BoolValue(value=truth):
            return str(truth)
        case ast.TextValue(value=text):
            return repr(text)
        case ast.Reference(name=name):
            return name.text
    raise AssertionError(node)


EXPRESSIONS = [
    ("a + b * c - d", "(- (+ a (* b c)) d)"),
    ("a - b - c", "(- (- a b) c)"),
    ("a / b * c", "(* (/ a b) c)"),
    ("(a + b) * c", "(* (+ a b) c)"),
    ("a -1", "(- a 1)"),
    ("-a * -1", "(* (- a) (- 1))"),
    ("- -a.b", "(- (- (. a b)))"),
    ("a + b to [m]", "(to (+ a b) m)"),
    ("a to [m] * 2 + 1", "(+ (* (to a m) 2) 1)"),
    ("a to [m] to [cm]", "(to (to a m) cm)"),
    ("(a to [m] + b) to [cm]", "(to (+ (to a m) b) cm)"),
    ("f(a to [rad], {b, 1 [deg]})[0]", "(at (f (to a rad) {b, 1[deg]}) (0,))"),
    ("a.b[2, 0].c", "(. (at (. a b) (2, 0)) c)"),
    ("a[1:3]", "(at a (1, 3))"),
    ("a[:3]", "(at a (None, 3))"),
    ("a[1:]", "(at a (1, None))"),
    ("{}", "{}"),
    ("{{1}, {}}", "{{1}, {}}"),
    ('{"a\\"b", TRUE, 0x10, .5}', "{'a\"b', True, 16, 0.5}"),
]


@pytest.mark.parametrize(("text", "tree"), EXPRESSIONS)
def test_bdsl_expression_precedence(text: str, tree: str) -> None:
    assert shown(expression(text)) == tree


def test_bdsl_expression_span_includes_parentheses() -> None:
    node = expression("(a + b) * (c)")
    assert node.span.text == "(a + b) * (c)"


@pytest.mark.parametrize("text", ["-" * 150 + "a", "+".join("a" * 150), "f(" * 60 + "a" + ")" * 60])
def test_bdsl_expression_depth_is_limited(text: str) -> None:
    report = Report()
    source = Source(Path("x.bdsl"), f"Bridge b {{ hub h = {text}; }};")
    file = parse_bdsl(source, report)
    depth = 0
    level = list(file.bridge.hubs[0].values) if file.bridge and file.bridge.hubs else []
    while level:
        depth += 1
        level = [operand for node in level for operand in operands(node)]
    assert depth <= 110
    assert [finding.code.id for finding in report] == (["RC005"] if depth < 10 else [])

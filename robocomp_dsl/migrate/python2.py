"""Convert Python 2 to Python 3.

In: the text of a module. Out: the text in Python 3, and what it may do otherwise, with its line.
`fissix`, the successor of lib2to3, converts the syntax. `/` and `round` become functions with
Python 2's results, where the result may differ.
"""

from __future__ import annotations

import ast
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass

HELPERS = "robocomp_dsl.runtime.robocomp.python2"
DIVIDE, ROUND = "divide", "round_half_up"

_SYNTAX = re.compile(
    r"^[ \t]*(?:print\s+[^\s(=]|print\s*>>|except\s+[^:#\n]+,\s*\w+\s*:|raise\s+[\w.]+\s*,"
    r"|exec\s+['\"\w])",
    re.MULTILINE,
)
"""Statements that exist only in Python 2."""
_NAMES = re.compile(
    r"\b(?:xrange|raw_input|unicode|basestring|execfile|unichr)\s*\(|\.(?:has_key|iteritems)\s*\("
    r"|^[ \t]*(?:import|from)[ \t]+(?:ConfigParser|Queue|StringIO|cPickle|urllib2|Tkinter|thread"
    r"|commands)\b",
    re.MULTILINE,
)
"""Names that exist only in Python 2."""
_GONE = {"cmp", "file", "coerce", "unichr", "execfile"}
"""Functions of Python 2 that are not converted."""
_SPECIAL_METHODS = {"__cmp__", "__div__", "__getslice__", "__setslice__"}
"""Methods that Python 3 does not call."""
_BYTES = {"check_output", "communicate", "recv", "recvfrom", "Serial", "urlopen", "b64encode"}
"""Calls whose results were texts, and are bytes now."""
_FLOATS = {"float", "sqrt", "sin", "cos", "tan", "atan2", "time", "radians", "degrees"}
"""Calls whose results are floats."""


_STYLE_FIXERS = ("idioms", "set_literal", "ws_comma", "buffer", "future")
"""Fixers that change what is valid in Python 3, or what is not sure."""


class CannotConvert(Exception):
    """The text is not Python 2 either, or fissix is not installed; the message says which.

    `line` is that of the error, 0 if there is none.
    """

    def __init__(self, message: str, line: int = 0) -> None:
        super().__init__(message)
        self.line = line


@dataclass(frozen=True, slots=True)
class ConvertedModule:
    """The text in Python 3; places that may do something else, with their lines."""

    text: str
    doubts: tuple[tuple[int, str], ...]


def looks_like_python2(text: str) -> bool:
    """Whether a text has statements or names of Python 2 that Python 3 lacks."""
    return bool(_SYNTAX.search(text) or _NAMES.search(text))


def convert(text: str) -> ConvertedModule:
    """The text in Python 3. Raises `CannotConvert`."""
    ended = text if text.endswith("\n") else f"{text}\n"
    converted = _with_python3_syntax(_with_even_indentation(ended))
    try:
        tree = ast.parse(converted)
    except (SyntaxError, ValueError, RecursionError) as error:
        line = getattr(error, "lineno", None) or 0
        message = f"it is Python 2, but converted it is not Python 3: {error}"
        raise CannotConvert(message, line) from None
    exact = any(
        isinstance(node, ast.ImportFrom)
        and node.module == "__future__"
        and any(alias.name == "division" for alias in node.names)
        for node in tree.body
    )
    edits = [] if exact else list(_division_edits(tree, converted))
    edits += _round_edits(tree, converted)
    result = _with_helpers(converted, tree, edits)
    inserted = result.count("\n") - converted.count("\n")
    doubts = tuple(sorted((line + inserted, doubt) for line, doubt in _doubts(tree)))
    return ConvertedModule(result, doubts)


def _with_python3_syntax(text: str) -> str:
    try:
        from fissix.pgen2.parse import ParseError  # noqa: PLC0415 - optional and slow to load
        from fissix.pgen2.tokenize import TokenError  # noqa: PLC0415
        from fissix.refactor import RefactoringTool, get_fixers_from_package  # noqa: PLC0415
    except ImportError:
        raise CannotConvert(
            "fissix, which converts Python 2, is not installed: pip install 'robocomp_dsl[migrate]'"
        ) from None
    fixers = [
        fixer
        for fixer in get_fixers_from_package("fissix.fixes")
        if not fixer.endswith(
            ("fix_idioms", "fix_set_literal", "fix_ws_comma", "fix_buffer", "fix_future")
        )
    ]
    tool = RefactoringTool(fixers, {"print_function": False})
    try:
        return str(tool.refactor_string(text, "module"))
    except (ParseError, TokenError, IndentationError, RecursionError) as error:
        place = getattr(error, "context", None)
        line = place[1][0] if place else getattr(error, "lineno", None) or 0
        raise CannotConvert("it is neither Python 3 nor Python 2", line) from None


def _with_even_indentation(text: str) -> str:
    """Tabs at the start of lines expanded to 8 columns, if tabs and spaces are mixed.

    Python 2 read them so; Python 3 rejects the mixture.
    """
    try:
        from fissix.pgen2 import tokenize  # noqa: PLC0415 - see above
    except ImportError:
        return text
    heads = {match[0] for match in re.finditer(r"^[ \t]+(?=\S)", text, re.MULTILINE)}
    if not any("\t" in head for head in heads) or not any(" " in head for head in heads):
        return text
    inside: set[int] = set()
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token[0] == tokenize.STRING:
                inside |= set(range(token[2][0] + 1, token[3][0] + 1))
    except (tokenize.TokenError, IndentationError):
        return text
    lines = text.splitlines(keepends=True)
    return "".join(
        line if number in inside else _with_spaces(line) for number, line in enumerate(lines, 1)
    )


def _with_spaces(line: str) -> str:
    body = line.lstrip(" \t")
    return line[: len(line) - len(body)].expandtabs(8) + body


_Edit = tuple[int, int, str]
"""Replace the text of [start, end)."""


class _Positions:
    """Offsets of syntax tree nodes in a text."""

    def __init__(self, text: str) -> None:
        self._lines = text.splitlines(keepends=True)
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line))

    def start(self, node: ast.expr | ast.stmt) -> int:
        return self._offset(node.lineno, node.col_offset)

    def end(self, node: ast.expr | ast.stmt) -> int:
        return self._offset(node.end_lineno or node.lineno, node.end_col_offset or 0)

    def _offset(self, line: int, column: int) -> int:
        before = self._lines[line - 1].encode()[:column]
        return self._starts[line - 1] + len(before.decode())


def _division_edits(tree: ast.Module, text: str) -> Iterator[_Edit]:
    """`a / b` becomes `divide(a , b)`, unless an operand is a float or both are numbers."""
    places = _Positions(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            if _is_float(node.left) or _is_float(node.right):
                continue
            at = _operator(text, places.end(node.left), places.start(node.right), "/")
            if _is_int(node.left) and _is_int(node.right):
                yield at, at + 1, "//"
                continue
            yield places.start(node), places.start(node), f"{DIVIDE}("
            yield at, at + 1, ","
            yield places.end(node), places.end(node), ")"
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Div):
            if _is_float(node.value):
                continue
            target = text[places.start(node.target) : places.end(node.target)]
            at = _operator(text, places.end(node.target), places.start(node.value), "/=")
            yield at, at + 2, f"= {DIVIDE}({target},"
            yield places.end(node), places.end(node), ")"


def _operator(text: str, start: int, end: int, operator: str) -> int:
    """The position of an operator between two operands; comments between them are skipped."""
    between = re.sub(r"#[^\n]*", lambda m: " " * len(m[0]), text[start:end])
    return start + between.index(operator)


def _is_int(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) is int


def _is_float(node: ast.expr) -> bool:
    """Whether an expression is a float for sure."""
    match node:
        case ast.Constant(value=value):
            return isinstance(value, float)
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in _FLOATS
        case ast.UnaryOp(operand=operand):
            return _is_float(operand)
        case ast.BinOp(left=left, right=right, op=ast.Add() | ast.Sub() | ast.Mult() | ast.Div()):
            return _is_float(left) or _is_float(right)
        case ast.Attribute(value=ast.Name(id="math" | "np" | "numpy"), attr="pi" | "e"):
            return True
    return False


def _round_edits(tree: ast.Module, text: str) -> Iterator[_Edit]:
    places = _Positions(text)
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name(id="round") as function):
                yield places.start(function), places.end(function), ROUND


def _with_helpers(text: str, tree: ast.Module, edits: list[_Edit]) -> str:
    """The text with edits and the import of the functions that they call."""
    names = sorted({n for n in (DIVIDE, ROUND) for edit in edits if n in edit[2]})
    # At equal positions what closes comes before what opens, and inner edits come first.
    ordered = sorted(enumerate(edits), key=lambda item: (item[1][0], item[1][1], item[0]))
    parts, position = [], 0
    for _, (start, end, new) in ordered:
        parts += [text[position:start], new]
        position = end
    result = "".join([*parts, text[position:]])
    if not names:
        return result
    lines = result.splitlines(keepends=True)
    at = _import_line(tree)
    line_end = "\r\n" if "\r\n" in text else "\n"
    lines.insert(at, f"from {HELPERS} import {', '.join(names)}{line_end}")
    return "".join(lines)


def _import_line(tree: ast.Module) -> int:
    """The number of lines before the first statement that is no docstring or `__future__`."""
    line = 0
    for statement in tree.body:
        is_doc = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
        is_future = isinstance(statement, ast.ImportFrom) and statement.module == "__future__"
        if not is_doc and not is_future:
            return statement.lineno - 1
        line = statement.end_lineno or line
    return line


def _doubts(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """The lines that may do something else in Python 3."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name(id=name)) if name in _GONE:
                yield node.lineno, f"`{name}` does not exist in Python 3"
            case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)) if name in _BYTES:
                yield node.lineno, f"`{name}` returned a text in Python 2, and bytes in Python 3"
            case ast.FunctionDef(name=name) if name in _SPECIAL_METHODS:
                yield node.lineno, f"Python 3 does not call `{name}`"

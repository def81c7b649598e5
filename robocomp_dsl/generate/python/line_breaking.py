"""Breaks the lines of generated Python: one-line statements in, broken like `ruff format`.

Templates write every statement on one line; statements longer than `layout.WIDTH` are parsed into
brackets and commas and laid out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from robocomp_dsl.generate.python.layout import (
    STEP,
    WIDTH,
    Brackets,
    Item,
    assignment,
    laid_out,
    statement,
)

_STRING = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'(?:[^'\\]|\\.)*'")
_HEAD_END = re.compile(r"( *\) -> )(.*)(:(?: \.\.\.)?)")
"""The last line of a function head whose parameters are already broken."""


def break_lines(text: str) -> str:
    """A module with all lines longer than `WIDTH` broken; docstrings and comments are unchanged."""
    return "".join(_broken_lines(text.split("\n")))[:-1]


def _broken_lines(lines: Iterable[str]) -> Iterator[str]:
    in_docstring = False
    for line in lines:
        code = line.lstrip(" ")
        indent = line[: len(line) - len(code)]
        is_code = not in_docstring and not code.startswith(("#", '"""'))
        if in_docstring:
            in_docstring = not code.endswith('"""')
        elif code.startswith('"""'):
            in_docstring = code == '"""' or not code.endswith('"""')
        yield f"{indent}{one_statement(code, indent) if is_code else code}\n"


def one_statement(code: str, indent: str = "") -> str:
    """A one-line statement, broken; without the indentation of its first line."""
    if len(indent) + len(code) <= WIDTH:
        return code
    if code.startswith(("def ", "class ")):
        return _block_head(code, indent)
    if code.startswith("from "):
        module, _, listed = code.partition(" import ")
        names = "".join(f"{indent}{STEP}{name},\n" for name in listed.split(", "))
        return f"{module} import (\n{names}{indent})"
    sign = next((separator for separator in (" = ", ": ") if _at_top(code, separator) >= 0), "")
    at = _at_top(code, sign) if sign else 0
    if code.startswith(("return ", "raise ")):
        sign, at = " ", code.index(" ")
    item = parsed(code[at + len(sign) :])
    if isinstance(item, Brackets):
        return statement(code[: at + len(sign)], item, indent)
    return assignment(code[:at], item, indent, sign) if sign in (" = ", ": ") else code


def _block_head(code: str, indent: str) -> str:
    """`def f(...) -> X:` and `class C(...):`: the first bracket is broken, then the result."""
    start, end = next(_brackets(code))
    items, _ = _items(code[start + 1 : end])
    whole = Brackets(code[: start + 1], items, code[end:])
    text = laid_out(whole, indent)
    last = text.rpartition("\n")[2]
    if len(last) <= WIDTH or not (found := _HEAD_END.fullmatch(last)):
        return text
    return text[: -len(last)] + found[1] + laid_out(parsed(found[2]), indent, WIDTH) + found[3]


def parsed(text: str) -> Item:
    """An expression as nested brackets; the last non-empty bracket is broken first."""
    filled = [(start, end) for start, end in _brackets(text) if end > start + 1]
    if not filled:
        return text
    start, end = filled[-1]
    items, is_tuple = _items(text[start + 1 : end])
    return Brackets(text[: start + 1], items, text[end:], is_tuple)


def _items(text: str) -> tuple[tuple[Item, ...], bool]:
    """The items between commas, and whether a trailing comma follows."""
    parts, start = [], 0
    for at, sign, depth in _signs(text):
        if sign == "," and not depth:
            parts.append(text[start:at].strip())
            start = at + 1
    last = text[start:].strip()
    parts += [last] if last else []
    return tuple(map(parsed, parts)), bool(parts) and not last


def _brackets(text: str) -> Iterator[tuple[int, int]]:
    """Positions at which the outermost brackets open and close."""
    start = 0
    for at, sign, depth in _signs(text):
        if sign in "([{" and depth == 1:
            start = at
        elif sign in ")]}" and not depth:
            yield start, at


def _at_top(text: str, sign: str) -> int:
    """Position of `sign` outside all brackets and strings; -1 if it does not occur."""
    places = (at for at, _, depth in _signs(text) if not depth and text.startswith(sign, at))
    return next(places, -1)


def _signs(text: str) -> Iterator[tuple[int, str, int]]:
    """Each character outside strings with its position and the bracket depth after it."""
    depth, at = 0, 0
    while at < len(text):
        if string := _STRING.match(text, at):
            at = string.end()
            continue
        depth += (text[at] in "([{") - (text[at] in ")]}")
        yield at, text[at], depth
        at += 1

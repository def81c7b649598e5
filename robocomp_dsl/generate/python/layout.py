"""Line breaking: nested brackets in, Python source out that `ruff format` does not change.

A bracket that fits stays on its line. Arguments that do not fit go on a line of their own; if that
is too long as well, and in all other brackets, each item gets a line and a trailing comma.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TypeAlias

from robocomp_dsl.record import ValueRecord

WIDTH = 88
STEP = "    "
INNER = STEP
"""Indentation of class members."""
BODY = STEP * 2
"""Indentation of statements in a method."""

_ARGUMENTS = re.compile(r"[\w\])]\($")
"""The last character of the head of a call or definition; other brackets are collections."""


class Brackets(ValueRecord):
    """`head` (ends with the open bracket), comma-separated `items`, `tail` (begins with the close).

    `is_tuple`: a single item keeps its comma on one line.
    """

    head: str
    items: tuple[Item, ...]
    tail: str
    is_tuple: bool = False

    @property
    def flat(self) -> str:
        """All on one line."""
        comma = "," if self.is_tuple and len(self.items) == 1 else ""
        return f"{self.head}{', '.join(flat(i) for i in self.items)}{comma}{self.tail}"


Item: TypeAlias = str | Brackets


def flat(item: Item) -> str:
    """`item` on one line."""
    return item if isinstance(item, str) else item.flat


def call(name: str, *items: Item, tail: str = ")") -> Brackets:
    """`name(items)`; `tail` is the text that follows, as in `) -> None:`."""
    return Brackets(f"{name}(", items, tail)


def tuple_of(*items: Item, head: str = "") -> Brackets:
    """`head(items,)`; `head` as in `inputs=`."""
    return Brackets(f"{head}(", items, ")", is_tuple=True)


def subscript(name: str, *items: Item) -> Brackets:
    """`name[items]`."""
    return Brackets(f"{name}[", items, "]")


def laid_out(item: Item, indent: str = "", used: int = 0, after: int = 0) -> str:
    """`item` as source. `used` columns of the first line and `after` columns of the last are taken.

    Later lines start with `indent`, the indentation of the statement.
    """
    if isinstance(item, str):
        return item
    line = item.flat
    if not item.items or len(indent) + used + len(line) + after <= WIDTH:
        return line
    inner = indent + STEP
    body = line[len(item.head) : -len(item.tail)]
    is_alone = item.head.startswith("def ") and len(item.items) == 1
    if _ARGUMENTS.search(item.head) and not is_alone and len(inner) + len(body) <= WIDTH:
        return f"{item.head}\n{inner}{body}\n{indent}{item.tail}"
    comma = "" if len(item.items) == 1 and _is_single(item) else ","
    rows = [f"{inner}{laid_out(i, inner, 0, len(comma))}{comma}\n" for i in item.items]
    return f"{item.head}\n{''.join(rows)}{indent}{item.tail}"


def _is_single(item: Brackets) -> bool:
    """Whether a comma after a single item would make it a tuple: a subscript, `a * (b + c)`."""
    is_group = item.head.endswith("(") and not _ARGUMENTS.search(item.head)
    return item.head.endswith("[") or (is_group and not item.is_tuple)


def statement(prefix: str, item: Item, indent: str = "") -> str:
    """`prefix` and `item` as one statement, without the indentation of its first line.

    If the head of `item` does not fit behind `return` but fits on a line of its own, the formatter
    encloses it in brackets on its own line.
    """
    inner = indent + STEP
    if prefix == "return " and isinstance(item, Brackets) and item.items:
        head = len(item.head)
        if len(inner) + head <= WIDTH < len(indent) + len(prefix) + head:
            return f"{prefix}(\n{inner}{laid_out(item, inner)}\n{indent})"
    return prefix + laid_out(item, indent, len(prefix))


def assignment(target: str, value: str, indent: str, sign: str = " = ") -> str:
    """`target = value`, with the value on a line of its own if it does not fit."""
    if len(indent) + len(target) + len(sign) + len(value) <= WIDTH:
        return f"{target}{sign}{value}"
    return f"{target}{sign}(\n{indent}{STEP}{value}\n{indent})"


def optional(name: str, type_: str, indent: str) -> str:
    """`name: type_ | None = None` as one of several parameters at `indent`."""
    flat_ = f"{name}: {type_} | None = None"
    # The formatter breaks at the bar: the line is one parameter and has no other break point.
    return flat_ if len(indent) + len(flat_) < WIDTH else f"{name}: {type_}\n{indent}| None = None"


def choice(target: str, then: str, condition: str, otherwise: str, indent: str) -> str:
    """`target = then if condition else otherwise`, broken like `ruff format`."""
    value = f"{then} if {condition} else {otherwise}"
    if len(indent) + len(target) + 3 + len(value) <= WIDTH:
        return f"{target} = {value}"
    inner = indent + STEP
    if len(inner) + len(value) > WIDTH:
        value = f"{then}\n{inner}if {condition}\n{inner}else {otherwise}"
    return f"{target} = (\n{inner}{value}\n{indent})"


def definition(
    name: str, parameters: Iterable[Item], returns: Item, indent: str = INNER, after: int = 0
) -> str:
    """`def name(parameters) -> returns:`, without the indentation of the first line.

    `after` columns follow on the last line.
    """
    answer = flat(returns)
    whole = call(f"def {name}", *parameters, tail=f") -> {answer}:")
    text = laid_out(whole, indent, 0, after)
    last = text.rpartition("\n")[2]
    if "\n" not in text or len(last) + after <= WIDTH or isinstance(returns, str):
        return text
    head = text[: -len(f") -> {answer}:")]
    return f"{head}) -> {laid_out(returns, indent, WIDTH)}:"


def class_head(name: str, base: Item) -> str:
    """`class name(base):`."""
    return laid_out(call(f"class {name}", base, tail="):"))


def natural(name: str) -> list[tuple[int, int, str]]:
    """Sort key for the order that ruff calls natural: `a2` before `a10`."""
    parts = re.findall(r"[0-9]+|[^0-9]", name)
    return [(ord(p[0]), 0, p) if not p[0].isdigit() else (ord("0"), int(p), "") for p in parts]

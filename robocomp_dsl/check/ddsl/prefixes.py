"""Prefixes (namespaces) of instances and the peers that are visible from them.

In: a prefix, and candidates with prefixes. Out: the prefix for the runtime, diagnostics about
invalid ones, and the candidates that the runtime would select by itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TypeVar

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast.base import Name, Text

_PART = "[A-Za-z_][A-Za-z0-9_.-]{0,99}"
PREFIX = re.compile(f"{_PART}(/{_PART}){{0,7}}")
"""The pattern of the runtime for prefixes; a test compares the two."""
_FAR = 1000

_T = TypeVar("_T")


def prefix_of(written: Name | Text | None, report: Report) -> str:
    """The prefix without surrounding `/`; empty if not written or invalid."""
    if written is None:
        return ""
    text = written.text if isinstance(written, Name) else written.value
    prefix = text.strip("/")
    if PREFIX.fullmatch(prefix):
        return prefix
    right = 'a prefix is a name such as `left`, or `"left/hand"` for a nested one'
    report.add(
        codes.INVALID_PREFIX, written.span, f'"{text:.60}" is not a valid prefix', help=right
    )
    return ""


def on_branch(prefix: str, found: Sequence[_T], of: Callable[[_T], str]) -> list[_T]:
    """The candidates on the same branch as `prefix`; `of` returns the prefix of a candidate.

    An empty prefix is on every branch.
    """
    return [item for item in found if _on_same_branch(prefix, of(item))]


def nearest(prefix: str, found: Sequence[_T], of: Callable[[_T], str]) -> list[_T]:
    """The nearest candidates on one branch: same prefix first, then outer, then inner ones."""
    least = min((_distance(prefix, of(item)) for item in found), default=0)
    return [item for item in found if _distance(prefix, of(item)) == least]


def _on_same_branch(first: str, second: str) -> bool:
    mine, theirs = f"{first}/", f"{second}/"
    return not first or not second or mine.startswith(theirs) or theirs.startswith(mine)


def _distance(mine: str, theirs: str) -> int:
    here, there = _depth(mine), _depth(theirs)
    return here - there if there <= here else _FAR


def _depth(prefix: str) -> int:
    return prefix.count("/") + 1 if prefix else 0

"""Prefixes of instances: names as running components have them, and who is near to whom.

In: a prefix as written, instances. Out: the prefix that the runtime takes, findings about others,
and those of several that one on their branch of names finds, as it would find them by itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TypeVar

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast_base import Name, Text

_PART = "[A-Za-z_][A-Za-z0-9_.-]{0,99}"
PREFIX = re.compile(f"{_PART}(/{_PART}){{0,7}}")
"""What the runtime takes for a prefix; a test holds the two against each other."""
_FAR = 1000

_T = TypeVar("_T")


def prefix_of(written: Name | Text | None, report: Report) -> str:
    """The prefix without `/` around it; empty where none was written, or none that can be used."""
    if written is None:
        return ""
    said = written.text if isinstance(written, Name) else written.value
    prefix = said.strip("/")
    if PREFIX.fullmatch(prefix):
        return prefix
    right = 'it is a name such as `left`, or `"left/hand"` for one inside another'
    report.add(codes.PREFIX, written.span, f'"{said:.60}" is no prefix', help=right)
    return ""


def on_branch(prefix: str, found: Sequence[_T], of: Callable[[_T], str]) -> list[_T]:
    """Those of `found` that one under `prefix` sees; `of` tells the prefix of each.

    These are those without a prefix, and all for one without. Other branches are not seen.
    """
    return [one for one in found if _related(prefix, of(one))]


def nearest(prefix: str, found: Sequence[_T], of: Callable[[_T], str]) -> list[_T]:
    """Those of `found`, all on one branch, that are nearest: beside, then outwards, then within."""
    least = min((_distance(prefix, of(one)) for one in found), default=0)
    return [one for one in found if _distance(prefix, of(one)) == least]


def _related(one: str, other: str) -> bool:
    mine, theirs = f"{one}/", f"{other}/"
    return not one or not other or mine.startswith(theirs) or theirs.startswith(mine)


def _distance(mine: str, theirs: str) -> int:
    here, there = _depth(mine), _depth(theirs)
    return here - there if there <= here else _FAR


def _depth(prefix: str) -> int:
    return prefix.count("/") + 1 if prefix else 0

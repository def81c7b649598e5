"""Kinds of configured values: guessed from texts, known in TOML, joined over several files.

In: values as a configuration gives them. Out: the kind that all of them have, and each as a value
of that kind. Ranges and enumerations are not guessed: nothing in a value says them.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable
from datetime import date, datetime, time

from robocomp_dsl.migrate.config import Value
from robocomp_dsl.model.parameter import Kind
from robocomp_dsl.model.types import Literal

_INT = re.compile(r"[-+]?(?:0|[1-9][0-9]{0,17})")
_FLOAT = re.compile(r"[-+]?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")
_LIST = re.compile(r"[^,;]+(?:[,;][^,;]*)+")
_EXACT = 2**53
"""Whole numbers up to here are the same as floating point numbers."""


def kind_of(value: Value, *, typed: bool) -> Kind:
    """The kind of one value; a text of the text form is looked at, one of TOML is a text."""
    if isinstance(value, bool):
        return Kind.BOOL
    if isinstance(value, int):
        return Kind.INT if abs(value) < 10**18 else Kind.STRING
    if isinstance(value, float):
        return Kind.FLOAT if math.isfinite(value) else Kind.STRING
    if isinstance(value, str) and not typed:
        return _kind_of_text(value)
    return Kind.STRING


def _kind_of_text(text: str) -> Kind:
    if text.lower() in ("true", "false"):
        return Kind.BOOL
    if _INT.fullmatch(text):
        return Kind.INT
    fits = len(text) < 40 and _FLOAT.fullmatch(text) and math.isfinite(float(text))
    return Kind.FLOAT if fits else Kind.STRING


def joined(kinds: Iterable[Kind]) -> Kind:
    """The kind that can hold values of all `kinds`; a text can hold any."""
    found = set(kinds)
    if found == {Kind.INT, Kind.FLOAT}:
        return Kind.FLOAT
    return found.pop() if len(found) == 1 else Kind.STRING


def as_kind(value: Value, kind: Kind) -> Literal:
    """`value` as one of `kind`, which is `kind_of` it or `joined` from that."""
    if kind is Kind.STRING:
        return as_text(value)
    if kind is Kind.BOOL:
        return value if isinstance(value, bool) else value.lower() == "true"
    return int(value) if kind is Kind.INT else float(value)


def as_text(value: Value) -> str:
    """`value` as it stands in a text; lists and dates as JSON and ISO 8601 have them."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, datetime | date | time):
        return value.isoformat()
    return json.dumps(value, ensure_ascii=False, default=str)


def is_exact(value: Value, kind: Kind) -> bool:
    """Whether `as_kind` loses nothing of a whole number that becomes a floating point one."""
    return kind is not Kind.FLOAT or not isinstance(value, int) or abs(value) <= _EXACT


def looks_like_list(text: str) -> bool:
    """Whether a text seems to be a list: `1,2,3` or `a;b`."""
    return bool(_LIST.fullmatch(text))

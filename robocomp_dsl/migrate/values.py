"""Types of configured values: inferred from strings, known in TOML, unified over several files.

In: values of configurations. Out: the kind that can hold all of them, and each value converted to
that kind. Ranges and enumerations cannot be inferred from values.
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
"""Integers up to here are exact as floating point numbers."""


def kind_of(value: Value, *, typed: bool) -> Kind:
    """The kind of one value; strings of the text format are parsed, those of TOML are strings."""
    if isinstance(value, bool):
        return Kind.BOOL
    if isinstance(value, int):
        return Kind.INT if abs(value) < 10**18 else Kind.STRING
    if isinstance(value, float):
        return Kind.FLOAT if math.isfinite(value) else Kind.STRING
    if isinstance(value, str) and not typed:
        return _kind_of_string(value)
    return Kind.STRING


def _kind_of_string(text: str) -> Kind:
    if text.lower() in ("true", "false"):
        return Kind.BOOL
    if _INT.fullmatch(text):
        return Kind.INT
    fits = len(text) < 40 and _FLOAT.fullmatch(text) and math.isfinite(float(text))
    return Kind.FLOAT if fits else Kind.STRING


def common_kind(kinds: Iterable[Kind]) -> Kind:
    """The kind that can hold values of all `kinds`; a string can hold any."""
    distinct = set(kinds)
    if distinct == {Kind.INT, Kind.FLOAT}:
        return Kind.FLOAT
    return distinct.pop() if len(distinct) == 1 else Kind.STRING


def convert_value(value: Value, kind: Kind) -> Literal:
    """`value` as one of `kind`, which is `kind_of` it or `joined` from that."""
    if kind is Kind.STRING:
        return format_value(value)
    if kind is Kind.BOOL:
        return value if isinstance(value, bool) else value.lower() == "true"
    return int(value) if kind is Kind.INT else float(value)


def format_value(value: Value) -> str:
    """`value` as a string; lists as JSON, dates as ISO 8601."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, datetime | date | time):
        return value.isoformat()
    return json.dumps(value, ensure_ascii=False, default=str)


def usual_text(value: Literal) -> str:
    """The text that an old worker gets for a parameter, unless its file has another spelling."""
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)


def is_exact(value: Value, kind: Kind) -> bool:
    """Whether `convert_value` is lossless for an integer that becomes a floating point number."""
    return kind is not Kind.FLOAT or not isinstance(value, int) or abs(value) <= _EXACT


def looks_like_list(text: str) -> bool:
    """Whether a string looks like a list: `1,2,3` or `a;b`."""
    return bool(_LIST.fullmatch(text))

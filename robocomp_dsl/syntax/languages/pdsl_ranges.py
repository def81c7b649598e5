"""PDSL: the range of a parameter whose `:` is missing or beside its number.

In: the attributes of a parameter in their order. Out: the same attributes with the range that was
meant, and a diagnostic. Only a second number after a default can be part of a range.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from robocomp_dsl.syntax.ast import pdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number, Text
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import Builder


def repair_range(attributes: Sequence[Any], builder: Builder) -> Sequence[Any]:
    """The attributes, where `5 0 10:`, `5 :0 10` and `5 0 10` are `5 0:10`."""
    has_default = False
    for index, (first, second) in enumerate(pairwise(attributes)):
        found = _split_range(first, second) if has_default else None
        if found:
            low, high, message = found
            written = f"{low.span.text}:{high.span.text}"
            both = low.span.subspan(first.span.start, second.span.end)
            builder.report(
                codes.UNEXPECTED,
                both,
                message,
                fix=builder.replace_fix(f"write `{written}`", both, written),
            )
            return [*attributes[:index], ast.Range(both, low, high), *attributes[index + 2 :]]
        has_default = has_default or isinstance(first, (Number, Text, Name))
    return attributes


def _split_range(first: object, second: object) -> tuple[Number, Number, str] | None:
    """Low and high bound and what is wrong with them; None if the two are not one range."""
    if isinstance(first, Number) and isinstance(second, Number):
        return first, second, f"`:` is missing after `{first.span.text}`"
    if isinstance(first, Number) and isinstance(second, ast.Range):
        high = second.low if not second.high else None
        message = f"`{high.span.text}` and `:` are in the wrong order" if high else ""
        return (first, high, message) if high else None
    if isinstance(first, ast.Range) and isinstance(second, Number):
        low = first.high if not first.low else None
        message = f"`:` and `{low.span.text}` are in the wrong order" if low else ""
        return (low, second, message) if low else None
    return None

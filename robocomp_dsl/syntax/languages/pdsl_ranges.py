"""PDSL: the range of a parameter whose `:` is missing or beside its number.

In: the attributes of a parameter in their order. Out: the same attributes with the range that was
meant, and a diagnostic. Only a second number after a default can be part of a range.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from robocomp_dsl.syntax.ast import pdsl as ast
from robocomp_dsl.syntax.ast.base import Number
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import Builder


def repair_range(attributes: Sequence[Any], builder: Builder) -> Sequence[Any]:
    """The attributes, where `5 0 10:`, `5 :0 10`, `5 0 10` and `5 0 [m] :10` have a range 0:10."""
    has_default = False
    for index, first in enumerate(attributes):
        for count in (2, 3):
            parts = attributes[index : index + count]
            found = _split_range(parts) if has_default and len(parts) == count else None
            if found is None:
                continue
            low, high, message = found
            whole = low.span.subspan(parts[0].span.start, parts[-1].span.end)
            middle = parts[1:-1]
            written = f"{low.span.text}:{high.span.text}"
            texts = [written, *(part.span.text for part in middle)]
            if isinstance(parts[0], Number):
                texts.reverse()
            fix = builder.replace_fix(f"write `{written}`", whole, " ".join(texts))
            builder.report(codes.UNEXPECTED, whole, message, fix=fix)
            range_ = ast.Range(whole, low, high)
            return [*attributes[:index], range_, *middle, *attributes[index + count :]]
        has_default = has_default or isinstance(first, Number)
    return attributes


def _split_range(parts: Sequence[Any]) -> tuple[Number, Number, str] | None:
    """Low and high bound and what is wrong with them; None if the parts are not one range."""
    first, second, last = parts[0], parts[1], parts[-1]
    if isinstance(first, Number) and isinstance(last, Number):
        is_range = first is not last and len(parts) == 2
        return (first, last, f"`:` is missing after `{first.span.text}`") if is_range else None
    if isinstance(first, Number) and isinstance(last, ast.Range):
        bound = last.low if len(parts) == 2 else last.high
        if bound is None or (last.low and last.high):
            return None
        words = (bound.span.text, ":") if len(parts) == 2 else (first.span.text, second.span.text)
        return first, bound, _in_wrong_order(*words)
    if isinstance(first, ast.Range) and isinstance(last, Number):
        bound = first.high if len(parts) == 2 else first.low
        if bound is None or (first.low and first.high):
            return None
        words = (":", bound.span.text) if len(parts) == 2 else (second.span.text, last.span.text)
        return bound, last, _in_wrong_order(*words)
    return None


def _in_wrong_order(first: str, second: str) -> str:
    return f"`{first}` and `{second}` are in the wrong order"

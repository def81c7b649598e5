"""How messages show types. In: a type. Out: text."""

from __future__ import annotations

from robocomp_dsl.model.bridge_ports import ItemsType, ValueType
from robocomp_dsl.model.types import Declaration, Sequence


def type_text(type_: ValueType) -> str:
    """A type as users write it."""
    if isinstance(type_, Sequence):
        return f"{type_text(type_.element)}[{type_.size or ''}]"
    return type_.qualified if isinstance(type_, Declaration) else type_.name


def a_type(type_: ValueType) -> str:
    """A type with its article, in back quotes."""
    text = type_text(type_)
    if isinstance(type_, ItemsType):
        return "a list"
    return f"an `{text}`" if text[0] in "aeioAEIO" else f"a `{text}`"

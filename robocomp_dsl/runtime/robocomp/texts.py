"""The texts of structs as with ZeroC Ice, which old code prints, and sometimes takes apart.

In: generated types. Out: `str(state)` is a block with a line per field, as from Ice 3.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum
from types import ModuleType
from typing import Any

from robocomp_dsl.runtime.types import Struct

STEP = "    "


def use_texts_of_ice(types: ModuleType) -> None:
    """Let the structs of a generated module have the texts that Ice gave them."""
    for declared in vars(types).values():
        if isinstance(declared, type) and issubclass(declared, Struct) and declared is not Struct:
            struct: Any = declared
            struct.__str__ = struct.__repr__ = ice_text


def ice_text(value: object) -> str:
    """The text of a struct, a sequence or a dictionary: a line break, and a block in braces."""
    return "\n" + "\n".join(_block(value, ""))


def _block(value: Any, indent: str) -> Iterator[str]:
    yield f"{indent}{{"
    for name, item in _members(value):
        if _is_block(item):
            yield f"{indent}{STEP}{name} = "
            yield from _block(item, indent + STEP)
        else:
            yield f"{indent}{STEP}{name} = {item.name if isinstance(item, Enum) else item}"
    yield f"{indent}}}"


def _members(value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Struct):
        kind = type(value)
        for attribute, (name, _) in zip(kind._names_, kind._fields_, strict=True):
            yield name, getattr(value, attribute)
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield "key", key
            yield "value", item
    else:
        yield from ((f"[{number}]", item) for number, item in enumerate(value))


def _is_block(value: object) -> bool:
    return not isinstance(value, str) and (
        isinstance(value, Struct | Mapping) or hasattr(value, "__len__")
    )

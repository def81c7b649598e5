"""Python names of fields and enumerators, by the rules of generated code.

The generator has the same rules (`robocomp_dsl.generate.names`); a test compares them.
"""

from __future__ import annotations

import keyword
from collections.abc import Iterable, Sequence

STRUCT_MEMBERS = frozenset(("rt",))
"""Names that generated structs need themselves."""
ERROR_MEMBERS = STRUCT_MEMBERS | {"add_note", "args", "with_traceback"}
"""Public members of the base of all declared exceptions."""
ENUM_MEMBERS = frozenset(
    (
        "as_integer_ratio",
        "bit_count",
        "bit_length",
        "conjugate",
        "denominator",
        "from_bytes",
        "imag",
        "is_integer",
        "mro",
        "name",
        "numerator",
        "real",
        "to_bytes",
        "value",
    )
)
"""What an `IntEnum` has itself."""


def unique_names(names: Sequence[str], reserved: Iterable[str]) -> list[str]:
    """An identifier for each of `names`: leading underscores move to the end, and so on."""
    unavailable = frozenset(reserved)
    taken = set(unavailable)
    identifiers = []
    for name in names:
        identifier = _identifier(name, unavailable)
        while identifier in taken:
            identifier += "_"
        taken.add(identifier)
        identifiers.append(identifier)
    return identifiers


def _identifier(name: str, reserved: frozenset[str]) -> str:
    bare = name.lstrip("_")
    moved = bare + "_" * (len(name) - len(bare))
    if not bare or bare[0].isdigit():
        moved = f"n{moved}"
    is_unusable = keyword.iskeyword(moved) or moved == "self" or moved in reserved
    return f"{moved}_" if is_unusable else moved

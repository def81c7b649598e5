"""Identifiers of ZeroC's Slice (Ice 3.7 manual, "Lexical Rules").

In: names of IDSL. Out: the names in exported Slice files, which are also those on Ice's wire.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robocomp_dsl.name_table import NameTable

_RESERVED_END = re.compile(r"(?:Prx|Ptr|Helper|Holder)$")
_BUILT_IN = ("LocalObject", "Object", "Value")
"""Built-in types of Slice: even an escaped name is sometimes taken for them."""


def valid_name(name: str) -> str:
    """`name` without forbidden parts: outer and double underscores, reserved affixes."""
    plain = re.sub("_+", "_", name).strip("_") or "n"
    if plain[0].isdigit() or plain[:3].lower() == "ice":
        plain = f"n_{plain}"
    return f"{plain}1" if _RESERVED_END.search(plain) or plain in _BUILT_IN else plain


def valid_path(qualified: str) -> str:
    """`Module::Name` with both names valid.

    The export also numbers names of a module that differ only in case; a type id needs its file.
    """
    return "::".join(valid_name(part) for part in qualified.split("::"))


def operation_names(interface: str, operations: Iterable[str]) -> dict[str, str]:
    """The Slice names of the operations of an interface, by their IDSL names."""
    listed = list(operations)
    scope = NameTable(valid_name, taken=(valid_name(interface),))
    # Valid names are claimed first, so that they stay unchanged.
    ordered = sorted(listed, key=lambda name: valid_name(name) != name)
    claimed = {name: scope.claim(name)[0] for name in ordered}
    return {name: claimed[name] for name in listed}

"""Names of a bridge from names of ports and topics."""

from __future__ import annotations

import re

_SUFFIX = re.compile(r":[io]$")
_RESERVED = frozenset(
    {"bridge", "call", "counter", "false", "function", "hub", "import", "input", "item", "length"}
    | {"middleware", "now", "number", "output", "over", "policy", "rate", "request", "service"}
    | {"stamp", "text", "to", "true"}
)


def identifier(text: str) -> str:
    """`rover_left_state` for `/rover/left/state:o`."""
    word = re.sub(r"\W+", "_", _SUFFIX.sub("", text), flags=re.ASCII).strip("_") or "port"
    if word[0].isdigit() or word.lower() in _RESERVED:
        word = f"port_{word}"
    return word


def unique(name: str, used: set[str]) -> str:
    """`name`, or `name_2`, …; it is added to `used`. Case does not distinguish names."""
    number, candidate = 1, name
    while candidate.lower() in used:
        number += 1
        candidate = f"{name}_{number}"
    used.add(candidate.lower())
    return candidate

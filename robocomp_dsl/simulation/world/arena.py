"""Memory for models with many bodies."""

from __future__ import annotations

from typing import Any

_MANY = 1000
_USUAL = 2**24


def reserve_arena(spec: Any, count: int) -> None:
    """Reserve memory for `count` bodies: collision detection lists all pairs of them."""
    if spec.memory < 0 and count > _MANY:
        spec.memory = _USUAL + 3 * count * count

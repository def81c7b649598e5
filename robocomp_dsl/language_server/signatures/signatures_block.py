"""Formatting of a block in braces, with a limited number of lines."""

from __future__ import annotations

from collections.abc import Sequence

MAX_LINES = 30


def format_block(head: str, lines: Sequence[str]) -> str:
    """`head { … };`, each line indented."""
    inside = [f"    {line}" for text in lines for line in text.splitlines()]
    if len(inside) > MAX_LINES:
        inside = [*inside[:MAX_LINES], f"    // … {len(inside) - MAX_LINES} more lines"]
    return "\n".join([head, "{", *inside, "};"])

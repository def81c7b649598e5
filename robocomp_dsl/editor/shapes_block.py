"""A head and the lines in its braces, cut where nobody reads on. In: lines. Out: text."""

from __future__ import annotations

from collections.abc import Sequence

MOST_LINES = 30


def block(head: str, lines: Sequence[str]) -> str:
    """`head { … };`, each line indented."""
    inside = [f"    {line}" for text in lines for line in text.splitlines()]
    if len(inside) > MOST_LINES:
        inside = [*inside[:MOST_LINES], f"    // … {len(inside) - MOST_LINES} more lines"]
    return "\n".join([head, "{", *inside, "};"])

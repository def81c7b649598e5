"""Places in the text of a bridge, as messages of the running bridge show them."""

from __future__ import annotations

from robocomp_dsl.source import Span


def place(span: Span) -> str:
    """`rover.bdsl:14`."""
    return f"{span.source.path.name}:{span.start_position[0]}"

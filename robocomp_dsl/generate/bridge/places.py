"""Places in the text of a bridge, as messages of the running bridge show them."""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.generate.literals import quoted
from robocomp_dsl.source import Span


def place(span: Span) -> str:
    """`rover.bdsl:14`."""
    return f"{span.source.path.name}:{span.start_position[0]}"


def places_text(places: tuple[tuple[str, str], ...]) -> str:
    """A dictionary of places by path."""
    return f"{{{', '.join(f'{quoted(path)}: {quoted(where)}' for path, where in places)}}}"


def tuple_text(items: Iterable[str]) -> str:
    """A tuple of expressions."""
    rows = list(items)
    return f"({', '.join(rows)}{',' * (len(rows) == 1)})"

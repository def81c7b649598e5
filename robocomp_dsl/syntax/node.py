"""What every node of a tree is: frozen, compared by value, and cheap."""

from __future__ import annotations

from robocomp_dsl.record import Value
from robocomp_dsl.source import Span


class Node(Value):
    """Something in a file; `span` runs from its first to its last character."""

    span: Span

    def __repr__(self) -> str:
        fields = type(self).__match_args__[1:]
        shown = (f"{field}={getattr(self, field)!r}" for field in fields)
        return f"{type(self).__name__}({', '.join(shown)})"

"""The base class of syntax tree nodes: immutable and compared by value."""

from __future__ import annotations

from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span


class Node(ValueRecord):
    """A syntax tree node; `span` covers its text."""

    span: Span

    def __repr__(self) -> str:
        fields = type(self).__match_args__[1:]
        values = (f"{field}={getattr(self, field)!r}" for field in fields)
        return f"{type(self).__name__}({', '.join(values)})"

"""Names that must be unique within one scope.

In: nodes with names. Out: the first node of every name; the others are reported.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, TypeVar

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.syntax.ast.base import Name


class Named(Protocol):
    """A node that has a name."""

    @property
    def name(self) -> Name:
        """Its name."""


Node = TypeVar("Node", bound=Named)


def unique_by_name(nodes: Iterable[Node], what: str, report: Report) -> list[Node]:
    """The first node of every name; `what` names their kind in messages (`field`, `port`)."""
    first: dict[str, Node] = {}
    for node in nodes:
        earlier = first.setdefault(node.name.text, node)
        if earlier is not node:
            report_duplicate(node.name, earlier.name, what, report)
    return list(first.values())


def report_duplicate(second: Name, first: Name, what: str, report: Report) -> None:
    """Report that `second` has the name of `first`."""
    report.add(
        codes.DUPLICATE_NAME,
        second.span,
        f"there are two {what}s called `{second.text}`",
        notes=[Note(first.span, f"`{first.text}` is first declared here")],
        help="give one of them another name, or remove it",
    )

"""Symbols, their occurrences in a file, and the index of a file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.source import Source, Span


@dataclass(frozen=True, slots=True, eq=False)
class Symbol:
    """A named declaration. `kind` is the user's word for it, `span` the declared name.

    `model_object` is the object of the model that the name stands for; `container` is the name of
    the enclosing declaration.
    """

    name: str
    kind: str
    span: Span
    model_object: object
    container: str = ""

    @property
    def key(self) -> tuple[str, int]:
        """Identifies the declaration: equal for all its occurrences."""
        return canonical_path(self.span.source.path), self.span.start


@dataclass(frozen=True, slots=True, eq=False)
class Occurrence:
    """A name in a file that refers to `symbol`.

    `rename_template` is the replacement text of a rename; `{}` stands for the new name.
    `definition` is the symbol that go-to-definition opens, if it differs from `symbol`: the port
    rather than its interface.
    """

    span: Span
    symbol: Symbol
    declares: bool = False
    rename_template: str = "{}"
    definition: Symbol | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Index:
    """The occurrences in one version of a file, in source order."""

    source: Source
    complete: bool
    occurrences: tuple[Occurrence, ...]

    def occurrences_at(self, offset: int) -> Iterator[Occurrence]:
        """The occurrences that contain or touch `offset`."""
        return (o for o in self.occurrences if o.span.start <= offset <= o.span.end)

    def declarations(self) -> Iterator[Symbol]:
        """The symbols that the file declares."""
        return (occurrence.symbol for occurrence in self.occurrences if occurrence.declares)

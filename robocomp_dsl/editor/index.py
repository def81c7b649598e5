"""What the names in a file mean: the question that most features ask.

In: a file and the workspace. Out: an `Index` with every name that is understood, in order of
writing. A name that is not understood has been reported by the checks and is left out here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.files import identity
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.source import Source, Span


@dataclass(frozen=True, slots=True, eq=False)
class Symbol:
    """Something that has a name. `kind` is the user's word for it, `thing` the model's object.

    `span` is the name where it is declared, and says which symbol this is.
    """

    name: str
    kind: str
    span: Span
    thing: object
    container: str = ""

    @property
    def key(self) -> tuple[str, int]:
        """The same for every mention of one declaration."""
        return identity(self.span.source.path), self.span.start


@dataclass(frozen=True, slots=True, eq=False)
class Mention:
    """A name in a file. `form` is what to write there after a renaming, `{}` being the new name.

    `nearer` is where a definition leads first: to the port and not at once to its interface.
    """

    span: Span
    symbol: Symbol
    declares: bool = False
    form: str = "{}"
    nearer: Symbol | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Index:
    """The names of one text."""

    source: Source
    complete: bool
    mentions: tuple[Mention, ...]

    def at(self, offset: int) -> Iterator[Mention]:
        """The names that the place touches."""
        return (one for one in self.mentions if one.span.start <= offset <= one.span.end)

    def declared(self) -> Iterator[Symbol]:
        """What the file declares."""
        return (one.symbol for one in self.mentions if one.declares)


Reader = Callable[[Path, Workspace], tuple[Source, bool, Iterable[Mention]]]
"""The names of a file in one language, and whether the text had no form errors."""


def readers() -> Mapping[str, Reader]:
    """File suffix (lower case) to reader."""
    from robocomp_dsl.editor import (  # noqa: PLC0415 - they build on this module
        names_cdsl,
        names_ddsl,
        names_idsl,
        names_innermodel,
        names_pdsl,
        names_scxml,
        names_smdsl,
    )

    return {
        ".idsl": names_idsl.read,
        ".cdsl": names_cdsl.read,
        ".pdsl": names_pdsl.read,
        ".ddsl": names_ddsl.read,
        ".smdsl": names_smdsl.read,
        ".scxml": names_scxml.read,
        ".xml": names_innermodel.read,
    }


def make_index(path: Path, workspace: Workspace) -> Index:
    """The index of the file at `path`. Raises `UnreadableSource`."""
    reader = readers().get(path.suffix.lower())
    if reader is None:
        return Index(workspace.files.read(path), complete=True, mentions=())
    source, complete, mentions = reader(path, workspace)
    ordered = sorted(mentions, key=lambda one: one.span.start)
    return Index(source, complete, tuple(ordered))

"""The nodes of documentation pages: inline text, links and blocks, independent of the format.

In: the user's texts. Out: data that `html.py` and `markdown.py` write; only they escape text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from robocomp_dsl.generate.doc.drawing import Drawing
from robocomp_dsl.generate.doc.target import Target


@dataclass(frozen=True, slots=True)
class PlainText:
    """Plain text."""

    text: str


@dataclass(frozen=True, slots=True)
class InlineCode:
    """A name or value in code style; a link if it has a `target`."""

    text: str
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Badge:
    """A short label, such as the pattern of an operation; `kind` is its style."""

    text: str
    kind: str


SPACE = PlainText(" ")
COMMA = PlainText(", ")

Inlines: TypeAlias = tuple[PlainText | InlineCode | Badge, ...]


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading of `level` 2 or 3; `anchor` is unique in its page."""

    kind: ClassVar[str] = "heading"
    level: int
    content: Inlines
    anchor: str


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs and lists, as parsed by `prose.py`."""

    kind: ClassVar[str] = "prose"
    parts: tuple[Paragraph | Bullets, ...]


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A paragraph."""

    kind: ClassVar[str] = "paragraph"
    content: Inlines


@dataclass(frozen=True, slots=True)
class Bullets:
    """A list."""

    kind: ClassVar[str] = "bullets"
    items: tuple[Inlines, ...]


@dataclass(frozen=True, slots=True)
class DeclarationBlock:
    """A declaration in its language; `lines` of code and links."""

    kind: ClassVar[str] = "signature"
    lines: tuple[Inlines, ...]


@dataclass(frozen=True, slots=True)
class TableRow:
    """A row of a table; `anchor` is "" if no link leads to it."""

    cells: tuple[Inlines, ...]
    anchor: str = ""


@dataclass(frozen=True, slots=True)
class DataTable:
    """A table; `description` describes it to screen readers."""

    kind: ClassVar[str] = "table"
    description: str
    header: tuple[str, ...]
    rows: tuple[TableRow, ...]


@dataclass(frozen=True, slots=True)
class FactTable:
    """Short facts, each with a name."""

    kind: ClassVar[str] = "facts"
    rows: tuple[tuple[str, Inlines], ...]


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing. `name` is the name of its file; `legend` explains its lines."""

    kind: ClassVar[str] = "figure"
    name: str
    drawing: Drawing
    legend: tuple[tuple[str, str], ...] = ()


Block: TypeAlias = Heading | Prose | DeclarationBlock | DataTable | FactTable | Figure


@dataclass(frozen=True, slots=True)
class DocumentationPage:
    """One page: `path` without suffix, `group` is its category ("Interface")."""

    path: str
    title: str
    group: str
    blocks: tuple[Block, ...]


def plain_text(content: str) -> Inlines:
    """Plain text; nothing for an empty text."""
    return (PlainText(content),) if content else ()


def inline_code(content: str, target: Target | None = None) -> Inlines:
    """Code; nothing for an empty text."""
    return (InlineCode(content, target),) if content else ()


def join_inlines(parts: Iterable[Inlines], separator: PlainText | InlineCode = COMMA) -> Inlines:
    """All non-empty parts, with `separator` between them."""
    joined: list[PlainText | InlineCode | Badge] = []
    for part in parts:
        if joined and part:
            joined.append(separator)
        joined.extend(part)
    return tuple(joined)


def data_table(
    description: str, header: Sequence[str], rows: Sequence[TableRow]
) -> tuple[DataTable, ...]:
    """A table without its empty columns; nothing if there are no rows."""
    if not rows:
        return ()
    used = [i for i in range(len(header)) if any(row.cells[i] for row in rows)]
    slim = (TableRow(tuple(row.cells[i] for i in used), row.anchor) for row in rows)
    return (DataTable(description, tuple(header[i] for i in used), tuple(slim)),)

"""What pages are made of: words, links and blocks, neither HTML nor Markdown yet.

In: the user's texts. Out: data that `html.py` and `markdown.py` write down; only they escape.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from robocomp_dsl.generate.doc.drawing import Drawing


@dataclass(frozen=True, slots=True)
class Target:
    """A page, its path without suffix, and a place in it, or "" for its beginning."""

    page: str
    anchor: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """Words as they are."""

    text: str


@dataclass(frozen=True, slots=True)
class Code:
    """A name or value, in the type of code; it leads somewhere where it has a `target`."""

    text: str
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Badge:
    """A short mark, such as the pattern of an operation; `kind` is its colour."""

    text: str
    kind: str


BLANK = Text(" ")
COMMA = Text(", ")

Words: TypeAlias = tuple[Text | Code | Badge, ...]


@dataclass(frozen=True, slots=True)
class Heading:
    """`level` 2 or 3; `anchor` is unique in its page."""

    kind: ClassVar[str] = "heading"
    level: int
    words: Words
    anchor: str


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs and lists, as `prose.py` makes them."""

    kind: ClassVar[str] = "prose"
    parts: tuple[Paragraph | Bullets, ...]


@dataclass(frozen=True, slots=True)
class Paragraph:
    """Lines that belong together."""

    kind: ClassVar[str] = "paragraph"
    words: Words


@dataclass(frozen=True, slots=True)
class Bullets:
    """A list."""

    kind: ClassVar[str] = "bullets"
    items: tuple[Words, ...]


@dataclass(frozen=True, slots=True)
class Signature:
    """A declaration as it is written in its language; `lines` of code and links."""

    kind: ClassVar[str] = "signature"
    lines: tuple[Words, ...]


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a table; `anchor` is "" where nothing leads to it."""

    cells: tuple[Words, ...]
    anchor: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """Rows below a head; `about` tells what it lists to those who do not see it."""

    kind: ClassVar[str] = "table"
    about: str
    head: tuple[str, ...]
    rows: tuple[Row, ...]


@dataclass(frozen=True, slots=True)
class Facts:
    """Short facts, each with its name."""

    kind: ClassVar[str] = "facts"
    rows: tuple[tuple[str, Words], ...]


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing. `name` is that of its file where it has one; `legend` explains its lines."""

    kind: ClassVar[str] = "figure"
    name: str
    drawing: Drawing
    legend: tuple[tuple[str, str], ...] = ()


Block: TypeAlias = Heading | Prose | Signature | Table | Facts | Figure


@dataclass(frozen=True, slots=True)
class Page:
    """One page: `path` without suffix, `group` what it is one of ("Interface")."""

    path: str
    title: str
    group: str
    blocks: tuple[Block, ...]


def text(words: str) -> Words:
    """Plain words; nothing for an empty text."""
    return (Text(words),) if words else ()


def code(words: str, target: Target | None = None) -> Words:
    """Code; nothing for an empty text."""
    return (Code(words, target),) if words else ()


def joined(parts: Iterable[Words], between: Text | Code = COMMA) -> Words:
    """All parts, with words between each two."""
    made: list[Text | Code | Badge] = []
    for one in parts:
        if made and one:
            made.append(between)
        made.extend(one)
    return tuple(made)


def table(about: str, head: Sequence[str], rows: Sequence[Row]) -> tuple[Table, ...]:
    """A table without the columns in which nothing stands; none without rows."""
    if not rows:
        return ()
    kept = [i for i in range(len(head)) if any(row.cells[i] for row in rows)]
    slim = (Row(tuple(row.cells[i] for i in kept), row.anchor) for row in rows)
    return (Table(about, tuple(head[i] for i in kept), tuple(slim)),)

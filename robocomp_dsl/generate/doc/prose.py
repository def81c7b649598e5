"""Parse doc comments: paragraphs, lists, and code in backticks.

In: doc comments of the model. Out: blocks and inline content.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.nodes import (
    Bullets,
    InlineCode,
    Inlines,
    Paragraph,
    PlainText,
    Prose,
)

_CODE_SPANS = re.compile(r"((?:`[^`]+`)+)")
_BULLET = re.compile(r"[-*+] +(\S.*)")


def parse_inline(line: str) -> Inlines:
    """A line of a doc comment; text in backticks is code."""
    return tuple(
        InlineCode(part.replace("`", "")) if i % 2 else PlainText(part)
        for i, part in enumerate(_CODE_SPANS.split(line))
        if part
    )


def parse_prose(doc: str) -> tuple[Prose, ...]:
    """The paragraphs and lists of a doc comment; nothing for an empty one."""
    parts: list[Paragraph | Bullets] = []
    for lines in _paragraphs(literals.lines(doc)):
        first_item = next(
            (i for i, line in enumerate(lines) if _BULLET.match(line.strip())), len(lines)
        )
        if lines[:first_item]:
            parts.append(
                Paragraph(parse_inline(" ".join(line.strip() for line in lines[:first_item])))
            )
        if lines[first_item:]:
            items = tuple(map(parse_inline, _items(lines[first_item:])))
            last = parts[-1] if parts else None
            if isinstance(last, Bullets):  # Markdown joins adjacent lists
                items = (*last.items, *items)
                parts.pop()
            parts.append(Bullets(items))
    return (Prose(tuple(parts)),) if parts else ()


def first_sentence(doc: str) -> Inlines:
    """The first sentence of a doc comment."""
    first = " ".join(line.strip() for line in next(_paragraphs(literals.lines(doc)), []))
    match = re.match(r".*?[.!?](?=\s)", first)
    return parse_inline(match[0] if match else first)


def _paragraphs(lines: Sequence[str]) -> Iterator[list[str]]:
    paragraph: list[str] = []
    for line in lines:
        if line.strip():
            paragraph.append(line)
        elif paragraph:
            yield paragraph
            paragraph = []
    if paragraph:
        yield paragraph


def _items(lines: Sequence[str]) -> list[str]:
    items: list[str] = []
    for line in lines:
        match = _BULLET.match(line.strip())
        if match:
            items.append(match[1])
        else:
            items[-1] += f" {line.strip()}"
    return items


def flatten_doc(doc: str) -> Inlines:
    """A doc comment as one line, for a table cell."""
    return parse_inline(" ".join(" ".join(literals.lines(doc)).split()))

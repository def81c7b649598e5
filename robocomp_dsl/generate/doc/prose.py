"""Doc comments as words: paragraphs, lists, and code between backticks.

In: doc comments as the model has them. Out: blocks and words; every text of a user becomes one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.words import Bullets, Code, Paragraph, Prose, Text, Words

_TICKED = re.compile(r"((?:`[^`]+`)+)")
_BULLET = re.compile(r"[-*+] +(\S.*)")


def inline(said: str) -> Words:
    """A line of a doc comment: what stands in backticks is code."""
    return tuple(
        Code(part.replace("`", "")) if i % 2 else Text(part)
        for i, part in enumerate(_TICKED.split(said))
        if part
    )


def prose(doc: str) -> tuple[Prose, ...]:
    """A doc comment: paragraphs between empty lines, and lists; nothing for an empty one."""
    parts: list[Paragraph | Bullets] = []
    for lines in _paragraphs(literals.lines(doc)):
        at = next((i for i, line in enumerate(lines) if _BULLET.match(line.strip())), len(lines))
        if lines[:at]:
            parts.append(Paragraph(inline(" ".join(line.strip() for line in lines[:at]))))
        if lines[at:]:
            items = tuple(map(inline, _items(lines[at:])))
            last = parts[-1] if parts else None
            if isinstance(last, Bullets):  # they would be one list in Markdown
                items = (*last.items, *items)
                parts.pop()
            parts.append(Bullets(items))
    return (Prose(tuple(parts)),) if parts else ()


def sentence(doc: str) -> Words:
    """The first paragraph of a doc comment, up to the end of its first sentence."""
    first = " ".join(line.strip() for line in next(_paragraphs(literals.lines(doc)), []))
    found = re.match(r".*?[.!?](?=\s)", first)
    return inline(found[0] if found else first)


def _paragraphs(lines: Sequence[str]) -> Iterator[list[str]]:
    held: list[str] = []
    for line in lines:
        if line.strip():
            held.append(line)
        elif held:
            yield held
            held = []
    if held:
        yield held


def _items(lines: Sequence[str]) -> list[str]:
    items: list[str] = []
    for line in lines:
        found = _BULLET.match(line.strip())
        if found:
            items.append(found[1])
        else:
            items[-1] += f" {line.strip()}"
    return items


def inline_doc(doc: str) -> Words:
    """A whole doc comment for one cell of a table."""
    return inline(" ".join(" ".join(literals.lines(doc)).split()))

"""The lists of a Bottle definition with their comments.

In: a source. Out: items, each with its words, its unit, `*`, and the lists in it. A comment above a
list or behind it belongs to it, the first comment of the file, before an empty line, to the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from robocomp_dsl.source import Source, Span

MAX_DEPTH = 20
"""Maximum depth of nested lists."""
_TOKEN = re.compile(
    r"(?P<blank>\s+)|(?P<comment>\#[^\n]*)|(?P<unit>\[[^\[\]\n]*\])|(?P<word>[A-Za-z_]\w*)"
    r"|(?P<repeat>\*|…|\.\.\.)|(?P<sign>.)",
    re.DOTALL | re.ASCII,
)
ReportMistake = Callable[[Span, str, str], object]
"""Reports a mistake: where, what, and how to correct it."""


class BottleItem:
    """A list in the file; `span` covers it with its parentheses."""

    def __init__(self, start: Span, doc: str) -> None:
        self.span = start
        self.doc = doc
        self.words: list[Span] = []
        self.unit: Span | None = None
        self.repeat: Span | None = None
        self.items: list[BottleItem] = []


def read_items(source: Source, report: ReportMistake) -> tuple[list[BottleItem], str]:
    """The lists outside all others, up to the first mistake there, and the comment of the file."""
    return _Reader(report).read(source)


class _Reader:
    """Collects the lists of one file."""

    def __init__(self, report: ReportMistake) -> None:
        self._report = report
        self._top: list[BottleItem] = []
        self._open: list[BottleItem] = []
        self._last: BottleItem | None = None
        self._head: list[str] = []
        self._above: list[str] = []

    def read(self, source: Source) -> tuple[list[BottleItem], str]:
        for found in _TOKEN.finditer(source.text):
            span = source.span(found.start(), found.end())
            match found.lastgroup:
                case "blank":
                    self._blank(found.group())
                case "comment":
                    self._comment(found.group().lstrip("#").strip())
                case _ if not self._token(found.lastgroup or "", span):
                    break
        else:
            for item in self._open[:1]:
                self._report(item.span, "this list has no `)`", "")
        size = len(source.text)
        for item in self._open:
            item.span = item.span.cover(source.span(size, size))
        if not self._top:
            self._head += self._above
        return self._top, "\n".join(self._head).strip()

    def _blank(self, text: str) -> None:
        if "\n" in text:
            self._last = None
        if text.count("\n") > 1:
            if not self._top:
                self._head += [*self._above, ""]
            self._above = []

    def _comment(self, text: str) -> None:
        if self._last is not None:
            self._last.doc = f"{self._last.doc}\n{text}".strip()
        else:
            self._above.append(text)

    def _token(self, kind: str, span: Span) -> bool:
        """Add a token to the lists; False if the rest of the file cannot be read."""
        text = span.text
        if text == "(":
            self._begin(span)
            if len(self._open) > MAX_DEPTH:
                self._report(span, f"lists are nested more than {MAX_DEPTH} deep", "")
                return False
        elif not self._open:
            self._report(span, f"expected `(`, not `{text}`", "each item is `(type name)`")
            return False
        elif text == ")":
            self._last = self._open.pop()
            self._last.span = self._last.span.cover(span)
        else:
            self._inside(self._open[-1], kind, span)
        return True

    def _begin(self, span: Span) -> None:
        item = BottleItem(span, "\n".join(self._above))
        (self._open[-1].items if self._open else self._top).append(item)
        self._open.append(item)
        self._above, self._last = [], None

    def _inside(self, item: BottleItem, kind: str, span: Span) -> None:
        """A word, unit or `*` of a list."""
        if kind == "word" and not (item.items or item.unit or item.repeat):
            item.words.append(span)
        elif kind == "unit" and item.unit is None:
            item.unit = span
        elif kind == "repeat" and item.repeat is None and item.words:
            item.repeat = span
        else:
            self._report(span, f"`{span.text}` is not expected here", "write `(type name [unit])`")

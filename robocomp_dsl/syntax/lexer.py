"""From text to tokens, with the comments and the doc comments put aside.

In: a source, the tables of its language, and where to report what is no token at all. Out: tokens
one by one, so that a file of four million braces costs no more than the parser reads of it.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator

from robocomp_dsl.source import Source
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.tables import END, Tables

_COMMENTS = frozenset(("DOC_BLOCK", "DOC_LINE", "BLOCK_COMMENT", "LINE_COMMENT"))
_DOCS = frozenset(("DOC_BLOCK", "DOC_LINE"))
_MISSPELT = frozenset(
    ("OTHER_QUOTES", "OPEN_STRING", "OPEN_COMMENT", "MERGE_MARK", "HASH_LINES", "SIGN", "STRAY")
)
_FRAME = re.compile(r"^[ \t]*\*(?!\*)[ \t]?|^[ \t]+|[ \t]+$", re.MULTILINE)


class Token:
    """A word of the language; `kind` is the name of its terminal. Offsets count characters."""

    __slots__ = ("end", "kind", "start", "text")

    def __init__(self, kind: str, text: str, start: int, end: int) -> None:
        self.kind = kind
        self.text = text
        self.start = start
        self.end = end


class Lexer:
    """The tokens of one source, and what stood beside them.

    `docs` maps the offset of a token to the doc comment in front of it, cleaned. Characters that
    are no token of the language come as tokens of the kind `STRAY`, which fits nowhere.
    """

    def __init__(self, source: Source, tables: Tables, findings: Findings) -> None:
        self.docs: dict[int, str] = {}
        self._text = source.text
        # Blanks that no token follows would be tried again from each of them.
        self._end = len(source.text.rstrip())
        self._tables = tables
        self._findings = findings

    def tokens(self, at: int = 0) -> Iterator[Token]:
        """The tokens from the offset `at` on, in order, then endless `$END`."""
        while at < self._end and not self._findings.full:
            at = yield from self._stretch(at)
        size = len(self._text)
        while True:
            yield Token(END, "", size, size)

    def _stretch(self, at: int) -> Generator[Token, None, int]:
        """The tokens from `at` on, up to characters that are not read; returns where to go on."""
        keyword, signs = self._tables.keywords.get, self._tables.signs
        any_case = self._tables.any_case
        doc: list[str] = []
        for match in self._tables.scanner.finditer(self._text, at, self._end):
            kind = match.lastgroup or ""
            text, end = match[kind], match.end()
            start = end - len(text)
            if kind == "ID":
                kind = keyword(text.lower() if any_case else text, kind)
            elif kind == "SIGN" and text in signs:
                kind = signs[text]
            elif kind in _COMMENTS:
                if kind in _DOCS:
                    doc.append(text)
                continue
            elif kind in _MISSPELT or (kind == "_SEMI" and text != ";"):
                kind = "STRAY" if kind == "SIGN" else kind
                kind, text, end = self._misspelt(kind, start, end)
                if not kind:
                    return end
            if doc:
                self.docs[start] = _clean(doc)
                doc.clear()
            yield Token(kind, text, start, end)
            if kind == "STRAY":
                return end
        return self._end

    def _misspelt(self, kind: str, start: int, end: int) -> tuple[str, str, int]:
        from robocomp_dsl.syntax import misspelt  # noqa: PLC0415 - most files need none of it

        return misspelt.READ[kind](self._findings, start, end)


def _clean(comments: list[str]) -> str:
    """The words of doc comments without slashes, stars and indentation."""
    words = (
        _FRAME.sub("", one[3:-2]) if one.startswith("/**") else one[3:].strip() for one in comments
    )
    return "\n".join(words).strip()

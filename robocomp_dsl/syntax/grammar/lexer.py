"""The lexer: from text to tokens; doc comments are collected separately.

In: a source, the tables of its language, and diagnostics for invalid characters. Out: tokens one by
one, so that the lexer does not read further than the parser.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator

from robocomp_dsl.source import Source
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.tables import Tables

_COMMENTS = frozenset(("DOC_BLOCK", "DOC_LINE", "BLOCK_COMMENT", "LINE_COMMENT"))
_DOCS = frozenset(("DOC_BLOCK", "DOC_LINE"))
_MISSPELT = frozenset(
    ("OTHER_QUOTES", "OPEN_STRING", "OPEN_COMMENT", "MERGE_MARK", "HASH_LINES", "SIGN", "STRAY")
)
_FRAME = re.compile(r"^[ \t]*\*(?!\*)[ \t]?|^[ \t]+|[ \t]+$", re.MULTILINE)


class Token:
    """A token; `kind` is the name of its terminal. Offsets count characters."""

    __slots__ = ("end", "kind", "start", "text")

    def __init__(self, kind: str, text: str, start: int, end: int) -> None:
        self.kind = kind
        self.text = text
        self.start = start
        self.end = end


class Lexer:
    """The tokens and doc comments of one source.

    `docs` maps the offset of a token to the text of the doc comment before it. Invalid characters
    become tokens of the kind `STRAY`, which no grammar accepts.
    """

    def __init__(self, source: Source, tables: Tables, findings: FileDiagnostics) -> None:
        self.docs: dict[int, str] = {}
        self._text = source.text
        # Trailing blanks would be scanned again from each of them.
        self._end = len(source.text.rstrip())
        self._tables = tables
        self._findings = findings

    def tokens(self, at: int = 0) -> Iterator[Token]:
        """The tokens from the offset `at`, in order, then `$END` repeatedly."""
        while at < self._end and not self._findings.too_many_errors:
            at = yield from self._scan(at)
        size = len(self._text)
        while True:
            yield Token(END, "", size, size)

    def _scan(self, at: int) -> Generator[Token, None, int]:
        """The tokens from `at` up to malformed characters; returns the offset to continue at."""
        keyword, signs = self._tables.keywords.get, self._tables.punctuation
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
                kind, text, end = self._misspelled(kind, start, end)
                if not kind:
                    return end
            if doc:
                self.docs[start] = _clean(doc)
                doc.clear()
            yield Token(kind, text, start, end)
            if kind == "STRAY":
                return end
        return self._end

    def _misspelled(self, kind: str, start: int, end: int) -> tuple[str, str, int]:
        from robocomp_dsl.syntax.recovery import misspelled  # noqa: PLC0415 - most files need none of it

        return misspelled.READERS[kind](self._findings, start, end)


def _clean(comments: list[str]) -> str:
    """The text of doc comments without slashes, asterisks and indentation."""
    words = (
        _FRAME.sub("", comment[3:-2]) if comment.startswith("/**") else comment[3:].strip()
        for comment in comments
    )
    return "\n".join(words).strip()

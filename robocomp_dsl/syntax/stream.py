"""Tokens that can be looked at before they are taken, put back, and passed over.

In: the tokens of a lexer. Out: the same, one at a time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Container, Iterable, Iterator

from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.tables import END

LONGEST = 100_000
"""Tokens that are passed over before the rest of the file is given up."""


class Garbage(Exception):
    """There is no end to what makes no sense; the argument is the last token looked at."""

    def __init__(self, last: Token) -> None:
        super().__init__()
        self.last = last


class Stream:
    """An endless row of tokens; the last one, `$END`, repeats."""

    def __init__(self, tokens: Iterator[Token]) -> None:
        self._tokens = tokens
        self._ahead: deque[Token] = deque()

    def take(self) -> Token:
        """The next token."""
        return self._ahead.popleft() if self._ahead else next(self._tokens)

    def look(self, count: int) -> tuple[Token, ...]:
        """At least the next `count` tokens, or as many as there are up to the first `$END`."""
        ahead = self._ahead
        while len(ahead) < count and not (ahead and ahead[-1].kind == END):
            ahead.append(next(self._tokens))
        return tuple(ahead)

    @property
    def has_more(self) -> bool:
        """Whether tokens were looked at that are not taken yet."""
        return bool(self._ahead)

    def go_on_with(self, tokens: Iterator[Token]) -> None:
        """Take all further tokens from another place."""
        self._ahead.clear()
        self._tokens = tokens

    def put(self, tokens: Iterable[Token]) -> None:
        """Put tokens in front; the first of them comes next."""
        self._ahead.extendleft(reversed(tuple(tokens)))

    def cut(self, at: int) -> None:
        """Let the file end here, at the offset `at`."""
        self.go_on_with(iter(lambda: Token(END, "", at, at), None))

    def pass_over_statement(self, depth: int, keywords: Container[str], text: str) -> Token:
        """Take the rest of a broken statement and return its last token.

        It ends with the next `;`, or with its own closing brace (`depth` are open already), or
        before the `}` of the block around it, or before one of the `keywords` at the start of a
        line.
        """
        for _ in range(LONGEST):
            last = self.take()
            depth += (last.kind == "LBRACE") - (last.kind == "RBRACE")
            following = self._peek()
            if following.kind == END or (last.kind == "_SEMI" and depth <= 0):
                return last
            if depth > 0 or (last.kind == "RBRACE" and following.kind == "_SEMI"):
                continue
            begins = following.kind in keywords and "\n" in text[last.end : following.start]
            if begins or "RBRACE" in (last.kind, following.kind):
                return last
        raise Garbage(last)

    def pass_over_until(self, keywords: Container[str]) -> tuple[Token, bool]:
        """Take everything before one of the `keywords` or the end.

        Returns the last token taken, and whether it was but a few words, signs or closing braces.
        """
        harmless = True
        for count in range(LONGEST):
            last = self.take()
            harmless = harmless and count < 6 and last.kind != "LBRACE"
            following = self._peek().kind
            if following == END or following in keywords:
                return last, harmless
        raise Garbage(last)

    def _peek(self) -> Token:
        if not self._ahead:
            self._ahead.append(next(self._tokens))
        return self._ahead[0]

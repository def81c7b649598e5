"""A token stream with lookahead, push-back and skipping.

In: the tokens of a lexer. Out: the same tokens, one at a time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Container, Iterable, Iterator

from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token

MAX_SKIPPED_TOKENS = 100_000
"""Tokens that are skipped before the rest of the file is skipped."""


class Unrecoverable(Exception):
    """Skipping found no end of the faulty text; `last` is the last token read."""

    def __init__(self, last: Token) -> None:
        super().__init__()
        self.last = last


class TokenStream:
    """An endless sequence of tokens; the last one, `$END`, repeats.

    The tokens in `ahead` come before the rest, `tokens`; `reset` replaces the latter.
    """

    def __init__(self, tokens: Iterator[Token]) -> None:
        self.tokens = tokens
        self.ahead: deque[Token] = deque()
        self.read_end = 0
        """Offset up to which error recovery has read the text beyond the tokens."""

    def note_read(self, offset: int) -> None:
        """Recovery has read the text up to `offset`: what it decides depends on that."""
        self.read_end = max(self.read_end, offset)

    def take(self) -> Token:
        """The next token."""
        return self.ahead.popleft() if self.ahead else next(self.tokens)

    def peek(self, count: int) -> tuple[Token, ...]:
        """At least the next `count` tokens, or all tokens up to the first `$END`."""
        ahead = self.ahead
        while len(ahead) < count and not (ahead and ahead[-1].kind == END):
            ahead.append(next(self.tokens))
        return tuple(ahead)

    @property
    def has_lookahead(self) -> bool:
        """Whether tokens were peeked that are not taken yet."""
        return bool(self.ahead)

    def reset(self, tokens: Iterator[Token]) -> None:
        """Continue with other tokens."""
        self.ahead.clear()
        self.tokens = tokens

    def push_back(self, tokens: Iterable[Token]) -> None:
        """Insert tokens before the remaining ones; the first of them is taken next."""
        self.ahead.extendleft(reversed(tuple(tokens)))

    def truncate(self, at: int) -> None:
        """End the file here, at the offset `at`."""
        self.reset(iter(lambda: Token(END, "", at, at), None))

    def skip_statement(self, depth: int, keywords: Container[str], text: str) -> Token:
        """Skip the rest of a faulty statement and return its last token.

        It ends with the next `;`, with its own closing brace (`depth` are open already), before the
        `}` of the enclosing block, or before one of the `keywords` at the start of a line.
        """
        for _ in range(MAX_SKIPPED_TOKENS):
            last = self.take()
            depth += (last.kind == "LBRACE") - (last.kind == "RBRACE")
            following = self._peek_next()
            if following.kind == END or (last.kind == "_SEMI" and depth <= 0):
                return last
            if depth > 0 or (last.kind == "RBRACE" and following.kind == "_SEMI"):
                continue
            begins = following.kind in keywords and "\n" in text[last.end : following.start]
            if begins or "RBRACE" in (last.kind, following.kind):
                return last
        raise Unrecoverable(last)

    def skip_until(self, keywords: Container[str]) -> tuple[Token, bool]:
        """Skip everything before one of the `keywords` or the end.

        Returns the last token skipped, and whether only a few tokens without `{` were skipped.
        """
        harmless = True
        for count in range(MAX_SKIPPED_TOKENS):
            last = self.take()
            harmless = harmless and count < 6 and last.kind != "LBRACE"
            following = self._peek_next().kind
            if following == END or following in keywords:
                return last, harmless
        raise Unrecoverable(last)

    def _peek_next(self) -> Token:
        if not self.ahead:
            self.ahead.append(next(self.tokens))
        return self.ahead[0]

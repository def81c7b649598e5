"""The state of an LR parser: its stack, its tokens, and the reductions of its rules.

In: tables, a builder, the tokens. Out: the values that the builder makes, on the stack.
"""

from __future__ import annotations

from collections import deque

from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Lexer, Token
from robocomp_dsl.syntax.grammar.reductions import StackEntry, prepare_reductions
from robocomp_dsl.syntax.grammar.tables import Tables
from robocomp_dsl.syntax.grammar.token_stream import TokenStream
from robocomp_dsl.syntax.languages.builder import Builder

RECENT_TOKENS = 64
"""Number of shifted tokens that recovery can read again."""


class ParserState:
    """The stack and tokens of one parser run over one source.

    `reductions[number](offset)` replaces the symbols of a rule by its result; see `reductions.py`.
    `recent_tokens` are the tokens that were shifted last. `last_reported_end` is the end of the
    last token before a reported error; `suppressed` counts the follow-on errors since then.
    """

    def __init__(self, tables: Tables, builder: Builder, findings: FileDiagnostics) -> None:
        self._lexer = Lexer(findings.source, tables, findings)
        builder.docs = self._lexer.docs
        self.tables = tables
        self.builder = builder
        self.findings = findings
        self.stream = TokenStream(self._lexer.tokens())
        self.stack: list[StackEntry] = [(0, None, 0, 0)]
        self.recent_tokens: deque[Token] = deque(maxlen=RECENT_TOKENS)
        self.last_reported_end = -1
        self.suppressed = 0
        self.reductions = prepare_reductions(tables, builder, findings, self.stack)

    def reduce(self, number: int, offset: int) -> None:
        """Replace the symbols of rule `number` by its result; an empty result is at `offset`."""
        self.reductions[number](offset)

    def resume_after(self, before: Token, suppressed: int | None) -> None:
        """Continue after the token `before`; the innermost list of items is complete up to it.

        `suppressed` is the number of follow-on errors if an error was reported after `before`.
        """
        state, items, start, _ = self.stack[-1]
        self.stack[-1] = (state, items, start, before.end)
        self.recent_tokens.clear()
        self.recent_tokens.append(before)
        self.last_reported_end, self.suppressed = (
            (-1, 0) if suppressed is None else (before.end, suppressed)
        )
        self.stream.reset(self._lexer.tokens(before.end))

    def truncate(self, at: int) -> None:
        """End the file here without reporting missing tokens."""
        self.findings.is_truncated = True
        self.stream.truncate(at)

"""The completion context of a position, computed with the parse tables.

In: a text and an offset. Out: a `CompletionContext`: the tokens before the cursor and the terminals
that may follow. The text after the cursor and the word that ends at the cursor are ignored.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.grammar.tables import Tables, load, name_action
from robocomp_dsl.syntax.languages.builder import Builder
from robocomp_dsl.syntax.recovery import recovery
from robocomp_dsl.syntax.recovery.error_context import ErrorContext

_COMMENT_OR_STRING = re.compile(r"""//[^\n]*|/\*.*?(?:\*/|\Z)|"[^"\n]*"?""", re.DOTALL)
_WORD = re.compile(r"[A-Za-z_]\w*\Z")
_BRACKET = re.compile(r"\[[^\]\n;{}]*\Z")
_STATEMENT_ENDS = frozenset(("_SEMI", "LBRACE", "RBRACE"))


@dataclass(frozen=True, slots=True)
class CompletionContext:
    """The cursor's place in the file. `start` is the offset of the word at the cursor.

    `statement` has the tokens since the last `;` or brace; `blocks` has the tokens of the
    statements that opened the enclosing blocks, outermost first. `accepted` are the terminals that
    may follow.
    `in_string` and `in_brackets`: a string or a `[` is open at the cursor.
    """

    path: Path
    source: Source
    offset: int
    start: int
    statement: list[Token]
    blocks: list[list[Token]]
    accepted: frozenset[str]
    tables: Tables
    in_string: bool = False
    in_brackets: bool = False

    @property
    def block(self) -> list[Token]:
        """The tokens of the statement that opened the innermost block; may be empty."""
        return self.blocks[-1] if self.blocks else []

    @property
    def previous_kind(self) -> str:
        """Kind of the token before the cursor in this statement; may be empty."""
        return self.statement[-1].kind if self.statement else ""

    @property
    def block_kind(self) -> str:
        """Kind of the first token of the innermost block; may be empty."""
        return self.block[0].kind if self.block else ""


def context_at(path: Path, source: Source, offset: int) -> CompletionContext | None:
    """The context at `offset`; None in a comment."""
    before = source.text[:offset]
    match = next(iter(deque(_COMMENT_OR_STRING.finditer(before), maxlen=1)), None)
    in_string = False
    if match and match.end() == offset:
        if not match[0].startswith('"'):
            if match[0].startswith("//") or not match[0].endswith("*/"):
                return None
        else:
            in_string = len(match[0]) == 1 or not match[0].endswith('"')
    bracket = None if in_string else _BRACKET.search(before)
    word = _WORD.search(before)
    if in_string and match:
        cut, start = match.start(), match.start() + 1
    elif bracket:
        cut, start = bracket.start(), bracket.start() + 1
    else:
        cut = start = word.start() if word else offset
    tables = load(path.suffix[1:].lower())
    statement, blocks, accepted = _parse_prefix(Source(path, before[:cut]), tables)
    return CompletionContext(
        path, source, offset, start, statement, blocks, accepted, tables, in_string, bool(bracket)
    )


class _NullBuilder(Builder):
    """Builds no tree: only the parser's states are used."""

    def __getattr__(self, name: str) -> Callable[..., list[Any]]:
        return lambda *_: []


def _parse_prefix(
    source: Source, tables: Tables
) -> tuple[list[Token], list[list[Token]], frozenset[str]]:
    """The current statement, the statements of its blocks, and the terminals that may follow."""
    findings = FileDiagnostics(source, Report())
    machine = ParserState(tables, _NullBuilder(findings), findings)
    statement: list[Token] = []
    blocks: list[list[Token]] = []
    stack, take = machine.stack, machine.stream.take
    token = take()
    counted = -1
    while token.kind != END:
        if token.start > counted:
            counted = token.start
            statement = _update_statement(token, statement, blocks)
        row = tables.actions[stack[-1][0]]
        action = row.get(token.kind)
        if action is None and token.kind in tables.keyword_terminals:
            action = name_action(row, token.kind)
        if action is None:
            machine.stream.push_back((token,))
            recovery.recover(machine)
            token = take()
        elif action < 0:
            machine.reduce(-1 - action, token.start)
        else:
            machine.recent_tokens.append(token)
            stack.append((action, token, token.start, token.end))
            token = take()
    states = [entry[0] for entry in stack]
    # Keywords that the parser would read as names are not candidates.
    strict = tables.replace(keyword_terminals=frozenset())
    situation = ErrorContext(strict, source, states, token, (token,), ())
    return statement, blocks, frozenset(situation.accepted_terminals())


def _update_statement(
    token: Token, statement: list[Token], blocks: list[list[Token]]
) -> list[Token]:
    """The statement with `token` appended; braces open and close `blocks`."""
    if token.kind == "LBRACE":
        blocks.append(statement)
    elif token.kind == "RBRACE" and blocks:
        blocks.pop()
    return [] if token.kind in _STATEMENT_ENDS else [*statement, token]

"""The LALR parser: from tokens to the result of the builder.

It is a table-driven LR parser. A keyword is read as a name where the grammar accepts no keyword, as
with Lark's contextual lexer. `recovery` handles syntax errors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from robocomp_dsl.syntax.codes import file as codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.grammar.tables import Tables, name_action
from robocomp_dsl.syntax.languages.builder import Builder

if TYPE_CHECKING:
    from robocomp_dsl.syntax.incremental.incremental import IncrementalParse

MAX_STACK_DEPTH = 400
"""Stack entries, about four per pair of braces, so that recursion over a tree is safe."""


def parse(
    tables: Tables,
    builder: Builder,
    findings: FileDiagnostics,
    incremental: IncrementalParse | None = None,
) -> Any:
    """Parse the source of `findings` and return the result of the builder."""
    parser = ParserState(tables, builder, findings)
    stack, trail, stream = parser.stack, parser.recent_tokens, parser.stream
    take, ahead, tokens = stream.take, stream.ahead, stream.tokens
    actions, words, reductions = tables.actions, tables.keyword_terminals, parser.reductions
    resting = tables.item_states
    token = take()
    while True:
        row = actions[stack[-1][0]]
        action = row.get(token.kind)
        if action is None and token.kind in words:
            action = name_action(row, token.kind)
        if action is None:
            token = _recover(parser, token)
            tokens = stream.tokens
        elif action < 0:
            reductions[-1 - action](token.start)
            if token.kind == END and stack[-1][0] == tables.accept:
                return stack[-1][1]
            if stack[-1][0] in resting:
                if findings.is_closed and not findings.is_truncated:
                    parser.truncate(token.start)
                    token = take()
                elif incremental:
                    token = incremental.at_item(parser, token)
                tokens = stream.tokens
        else:
            trail.append(token)
            stack.append((action, token, token.start, token.end))
            if len(stack) > MAX_STACK_DEPTH:
                _too_deep(parser, token)
                tokens = stream.tokens
            # As `stream.take()`, which takes longer.
            token = ahead.popleft() if ahead else next(tokens)


def _recover(parser: ParserState, token: Token) -> Token:
    from robocomp_dsl.syntax.recovery import recovery  # noqa: PLC0415 - needed for syntax errors only

    parser.stream.push_back((token,))
    recovery.recover(parser)
    return parser.stream.take()


def _too_deep(parser: ParserState, token: Token) -> None:
    """Report excessive nesting and skip the rest of the file."""
    parser.findings.add(
        codes.NESTED_TOO_DEEPLY, token.start, token.end, "blocks are nested too deeply"
    )
    parser.truncate(token.start)

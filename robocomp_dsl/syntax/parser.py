"""The LALR parser: tokens in, whatever the builder makes of them out.

It follows the tables as any LR parser does. A keyword is read as a name where no keyword fits, as
with Lark's contextual lexer. On an error it asks `repair` for a small correction with which the
text goes on to make sense; without one it drops the statement, and takes up again behind it.
"""

from __future__ import annotations

from collections import deque
from typing import Any, TypeAlias

from robocomp_dsl.source import Span
from robocomp_dsl.syntax import codes, repair
from robocomp_dsl.syntax.builder import Builder
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Lexer, Token
from robocomp_dsl.syntax.situation import Situation, expectation, quote
from robocomp_dsl.syntax.stream import Stream
from robocomp_dsl.syntax.tables import END, Tables, name_action

DEEPEST = 400
"""Entries of the stack, about four for a pair of braces: readers of a tree may recurse safely."""

LOOK_AHEAD = 24
TRAIL = 64
"""Tokens looked at in front of and behind an error."""

Entry: TypeAlias = tuple[int, Any, int, int]
"""State, value of the symbol that led to it, and the characters [start, end) of that symbol."""


class Parser:
    """One run over one source."""

    def __init__(self, tables: Tables, builder: Builder, findings: Findings) -> None:
        self._tables = tables
        self._builder = builder
        self._findings = findings
        self._source = findings.source
        lexer = Lexer(findings.source, tables, findings)
        builder.docs = lexer.docs
        self._stream = Stream(lexer.tokens())
        self._stack: list[Entry] = [(0, None, 0, 0)]
        self._trail: deque[Token] = deque(maxlen=TRAIL)
        self._told_behind = -1
        self._calls = [getattr(builder, rule.method, None) for rule in tables.rules]

    def run(self) -> Any:
        """What the builder made of the whole file."""
        tables, stack, take = self._tables, self._stack, self._stream.take
        actions, words, trail = tables.actions, tables.words, self._trail
        token = take()
        while True:
            row = actions[stack[-1][0]]
            action = row.get(token.kind)
            if action is None:
                if token.kind in words:
                    action = name_action(row, token.kind)
                if action is None:
                    self._stream.put((token,))
                    self._recover()
                    token = take()
                    continue
            if action < 0:
                self._reduce(-1 - action, token.start)
                if token.kind == END and stack[-1][0] == tables.accept:
                    return stack[-1][1]
                continue
            trail.append(token)
            stack.append((action, token, token.start, token.end))
            if len(stack) > DEEPEST:
                self._too_deep(token)
            token = take()

    def _reduce(self, number: int, at: int) -> None:
        """Replace the symbols of a rule by the one that it makes of them."""
        rule, stack = self._tables.rules[number], self._stack
        length = rule.length
        if rule.unwraps and length == 1 and not rule.picks[0].terminal:
            _, value, start, end = stack.pop()
        else:
            symbols = stack[-length:] if length else []
            del stack[len(stack) - length :]
            start, end = (symbols[0][2], symbols[-1][3]) if length else (at, at)
            value = self._value(number, symbols, start, end)
        stack.append((self._tables.gotos[stack[-1][0]][rule.origin], value, start, end))

    def _value(self, number: int, symbols: list[Entry], start: int, end: int) -> Any:
        rule, leaf = self._tables.rules[number], self._builder.leaf
        children: list[Any] = []
        for pick in rule.picks:
            value: Any = symbols[pick.index][1] if pick.index >= 0 else None
            if pick.terminal:
                children.append(leaf(pick.terminal, value))
            elif not pick.spliced:
                children.append(value)
            elif children:
                children += value
            else:
                # The list of a repetition grows in place, or long files would take ages.
                children = value
        call = self._calls[number]
        if call:
            return call(Span(self._source, start, end), *children)
        return children[0] if rule.unwraps else children

    def _recover(self) -> None:
        """Report what is wrong with the next token and make parsing possible again."""
        self._complete_statement()
        base = max(i for i, entry in enumerate(self._stack) if entry[0] in self._tables.restarts)
        begun = len(self._stack) > base + 1
        item = self._since(self._stack[base + 1][2]) if begun else []
        situation = self._situation()
        outside = self._builder.has_block and not situation.opened
        if outside and (not begun or (item and item[0].kind == "ID")):
            self._pass_over_stray(situation, item, base)
            return
        made = repair.choose(situation, item, base + 1)
        expected = f"expected {expectation(situation, self._builder.ITEMS)}"
        told = f"{expected}, found {quote(situation.ahead[0])}"
        if made:
            self._tell(situation, made, told)
            self._apply(made)
        else:
            self._tell(situation, repair.hopeless(situation), told)
            self._drop(situation, base)
        if self._findings.full:
            self._cut(situation.ahead[0].start)

    def _since(self, start: int) -> list[Token]:
        """The tokens taken since the one that begins at `start`, if they are still known."""
        item = [token for token in self._trail if token.start >= start]
        return item if item and item[0].start == start else []

    def _complete_statement(self) -> None:
        """Reduce what is complete whatever follows, so that it is not lost with what is not."""
        while True:
            following = set(self._tables.actions[self._stack[-1][0]].values())
            if len(following) != 1 or max(following) >= 0:
                return
            self._reduce(-1 - following.pop(), self._stack[-1][3])

    def _situation(self) -> Situation:
        return Situation(
            tables=self._tables,
            source=self._source,
            states=[entry[0] for entry in self._stack],
            before=self._trail[-1] if self._trail else Token("", "", 0, 0),
            ahead=self._stream.look(LOOK_AHEAD),
            opened=_opened(self._stack),
        )

    def _tell(self, situation: Situation, made: repair.Repair, told: str) -> None:
        """Report once for a place: what follows without a step forward is a consequence."""
        cut = situation.ahead[0].kind == END and self._findings.cut
        if self._told_behind != situation.before.end and not cut:
            made.tell(self._findings, told)
        self._told_behind = -1 if made.put else situation.before.end

    def _apply(self, made: repair.Repair) -> None:
        for _ in range(made.skip):
            self._stream.take()
        if made.keep:
            again = self._since(self._stack[made.keep][2])
            del self._stack[made.keep :]
            for _ in again:
                self._trail.pop()
        self._stream.put(made.put)

    def _drop(self, situation: Situation, base: int) -> None:
        """Give up the statement that began above entry `base` and pass over the rest of it."""
        token, inside = situation.ahead[0], len(_opened(self._stack[base + 1 :]))
        if token.kind == END:
            kept, closing = situation.closing()
            del self._stack[kept:]
            self._stream.put(closing)
            return
        del self._stack[base + 1 :]
        if token.kind != "RBRACE" or inside or not situation.opened:
            here = self._tables.words.intersection(self._tables.actions[self._stack[-1][0]])
            self._trail.append(self._stream.pass_over_statement(inside, here, self._source.text))

    def _pass_over_stray(self, situation: Situation, item: list[Token], base: int) -> None:
        """Report what stands behind the end of the block that the file is about."""
        del self._stack[base + 1 :]
        here = self._tables.words.intersection(self._tables.actions[self._stack[-1][0]])
        first, last = (item or situation.ahead)[0], situation.before
        harmless = True
        if situation.ahead[0].kind != END:
            last, harmless = self._stream.pass_over_until(here)
            self._trail.append(last)
        made = repair.stray_text(first, last, harmless)
        self._tell(situation, made, made.message)

    def _too_deep(self, token: Token) -> None:
        self._findings.add(
            codes.TOO_DEEP, token.start, token.end, "blocks are nested too deeply to be meant"
        )
        self._cut(token.start)

    def _cut(self, at: int) -> None:
        """Let the file end here, without a word on what is then missing."""
        self._findings.cut = True
        self._stream.cut(at)


def _opened(entries: list[Entry]) -> list[Token]:
    """The braces among the entries that no other entry closes."""
    opened: list[Token] = []
    for _, value, _, _ in entries:
        if isinstance(value, Token) and value.kind == "LBRACE":
            opened.append(value)
        elif isinstance(value, Token) and value.kind == "RBRACE":
            del opened[-1:]
    return opened

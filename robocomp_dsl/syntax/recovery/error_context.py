"""The parser state at a syntax error, and which continuations the grammar would accept.

In: a copy of the parser's states and the next tokens. Out: answers, without side effects.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.tables import Tables, name_action

LOOK_BACK = 1000
"""Characters before a statement that a repair may look at: the statement before, keywords."""

WINDOW = 5
"""A repair after which this many tokens are accepted is considered correct."""

_HIDDEN_TERMINALS = frozenset(("PLUS", "_INHERITS", "EXTENDS"))
"""Terminals that exist only to report mistakes; they are not suggested."""

_RARE_TERMINALS = frozenset(("LESSTHAN", "_SCOPE", "BRACKETED"))
"""Terminals that are not suggested where others are accepted, too."""

_TERMINAL_NAMES = {
    "ID": "a name",
    "NUMBER": "a number",
    "STRING": 'a "string"',
    "BRACKETED": "`[`",
    END: "the end of the file",
}


class ErrorContext(ValueRecord):
    """`lookahead[0]` is the unexpected token, `previous` the last accepted one.

    `open_braces` are the braces that are not closed yet, innermost last. `lone_semicolons` are the
    offsets of superfluous `;` that are apart from the one before.
    """

    tables: Tables
    source: Source
    states: Sequence[int]
    previous: Token
    lookahead: Sequence[Token]
    open_braces: Sequence[Token]
    lone_semicolons: Sequence[int] = ()

    def count_accepted(self, kinds: Iterable[str]) -> int:
        """How many of the terminals are accepted, one after the other."""
        states = list(self.states)
        count = 0
        for kind in kinds:
            if not self._shift(states, kind):
                break
            count += 1
            if kind == END:
                return count + WINDOW
        return count

    def states_after(self, keep: int, tokens: Iterable[Token]) -> list[int] | None:
        """The first `keep` states and those after the tokens; None if one is not accepted."""
        states = list(self.states[:keep])
        accepted = all(self._shift(states, token.kind) for token in tokens)
        return states if accepted else None

    def lookahead_score(self, put: Sequence[str] = (), skip: int = 0) -> int:
        """How many of the next tokens are accepted after `put` replaces the first `skip`.

        Less than 0 if not all of `put` is accepted; the end of the file counts like many tokens.
        """
        rest = [token.kind for token in self.lookahead[skip : skip + WINDOW]]
        return self.count_accepted([*put, *rest]) - len(put)

    def accepted_terminals(self) -> list[str]:
        """The terminals that are accepted next; a keyword only if it is not read as a name."""
        return [
            kind
            for kind in self.tables.actions[self.states[-1]]
            if self._shift(list(self.states), kind, as_name=False)
        ]

    def starts_line(self) -> bool:
        """Whether the unexpected token begins a line."""
        return "\n" in self.source.text[self.previous.end : self.lookahead[0].start]

    def is_single_stray(self) -> bool:
        """Whether the only error is one invalid character."""
        return self.lookahead[0].kind == "STRAY" and self.lookahead_score(skip=1) >= 2

    def nested_module(self, item: Sequence[Token]) -> Token | None:
        """The `module` keyword of a module nested in another one (indented deeper than it).

        `module` is read as a name there, so it may be the first token of the statement, `item`.
        """
        first = item[0] if item else self.lookahead[0]
        if self.tables.language != "idsl" or first.text != "module" or not self.open_braces:
            return None
        deeper = self._indent(first.start) > self._indent(self.open_braces[0].start)
        return first if deeper else None

    def _indent(self, offset: int) -> int:
        """The number of blanks at the start of the line at `offset`; a tab counts as one."""
        text = self.source.text
        start = max(text.rfind("\n", 0, offset), text.rfind("\r", 0, offset)) + 1
        line = text[start:offset]
        return len(line) - len(line.lstrip())

    def error_range(self) -> tuple[int, int]:
        """The range to report: the unexpected token, or the end of the previous one at `$END`."""
        token = self.lookahead[0]
        return (self.previous.end,) * 2 if token.kind == END else (token.start, token.end)

    def closing_tokens(self) -> tuple[int, list[Token]]:
        """The number of states to keep and the tokens to insert so that the file can end."""
        states = list(self.states)
        while True:
            kinds = self._closing_terminals(states)
            if kinds is not None:
                at = self.previous.end
                return len(states), [Token(kind, "", at, at) for kind in kinds]
            states.pop()
            while states[-1] not in self.tables.item_states:
                states.pop()

    def _closing_terminals(self, states: list[int]) -> list[str] | None:
        """The punctuation after which the file may end; `}` first, as each closes a block."""
        kinds: list[str] = []
        while not self._shift(list(states), END):
            tried = ((kind, list(states)) for kind in ("RBRACE", "_SEMI"))
            accepted = next(
                (candidate for candidate in tried if self._shift(candidate[1], candidate[0])), None
            )
            if accepted is None or len(kinds) > 2 * len(self.states):
                return None
            kinds.append(accepted[0])
            states = accepted[1]
        return kinds

    def _shift(self, states: list[int], kind: str, *, as_name: bool = True) -> bool:
        actions, words = self.tables.actions, self.tables.keyword_terminals
        while True:
            row = actions[states[-1]]
            action = row.get(kind)
            if action is None and as_name and kind in words:
                action = name_action(row, kind)
            if action is None:
                return False
            if action >= 0:
                states.append(action)
                return True
            rule = self.tables.rules[-1 - action]
            if rule.length:
                del states[-rule.length :]
            states.append(self.tables.gotos[states[-1]][rule.origin])
            if kind == END and states[-1] == self.tables.accept:
                return True


def describe_expected(context: ErrorContext, items: Mapping[str, str]) -> str:
    """The tokens or items that are accepted next; `items` names the items of a block."""
    accepted = context.accepted_terminals()
    here = context.tables.gotos[context.states[-1]]
    words = [items[name] for name in here if name in items]
    if words:
        kinds = [kind for kind in accepted if kind == "RBRACE"]
    else:
        kinds = [kind for kind in accepted if kind not in _HIDDEN_TERMINALS]
        kinds = [kind for kind in kinds if kind not in _RARE_TERMINALS] or kinds
    if kinds == ["ID"] and context.previous.kind == "NUMBER":
        return "a unit of time (`ms`, `s`, `min`, `h`)"
    texts = context.tables.terminal_texts
    words += sorted(_TERMINAL_NAMES[kind] for kind in kinds if kind in _TERMINAL_NAMES)
    words += sorted(f"`{texts[kind]}`" for kind in kinds if kind in texts)
    return f"{', '.join(words[:-1])} or {words[-1]}" if len(words) > 1 else "".join(words)


def quote_token(token: Token) -> str:
    """The token as printed in a message."""
    if token.kind == END:
        return "the end of the file"
    text = token.text if len(token.text) <= 30 else token.text[:27] + "…"
    return f"`{text}`" if "`" not in text else text

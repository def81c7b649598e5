"""Where the parser stands when it is stuck, and what would happen if the text went on otherwise.

In: a copy of the parser's states and the next tokens. Out: answers, without side effects.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from robocomp_dsl.record import Value
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.tables import END, Tables, name_action

WINDOW = 5
"""A correction after which so many tokens fit is taken for what was meant."""

_UNSAID = frozenset(("PLUS", "_INHERITS", "EXTENDS"))
"""Terminals that only serve to understand mistakes: nobody is told to write them."""

_RARE = frozenset(("LESSTHAN", "_SCOPE", "BRACKETED"))
"""Terminals not worth telling of where others may stand, too."""

_NAMES = {
    "ID": "a name",
    "NUMBER": "a number",
    "STRING": 'a "text"',
    "BRACKETED": "`[`",
    END: "the end of the file",
}


class Situation(Value):
    """`ahead[0]` is the token that does not fit, `before` the last that did.

    `opened` are the braces not closed yet, innermost last.
    """

    tables: Tables
    source: Source
    states: Sequence[int]
    before: Token
    ahead: Sequence[Token]
    opened: Sequence[Token]

    def shifts(self, kinds: Iterable[str]) -> int:
        """How many of the terminals fit, one after the other."""
        states = list(self.states)
        count = 0
        for kind in kinds:
            if not self._shift(states, kind):
                break
            count += 1
            if kind == END:
                return count + WINDOW
        return count

    def reach(self, put: Sequence[str] = (), skip: int = 0) -> int:
        """How many of the next tokens fit with `put` in the place of the first `skip`.

        Less than 0 when not even `put` does; the end of the file counts like many tokens.
        """
        rest = [token.kind for token in self.ahead[skip : skip + WINDOW]]
        return self.shifts([*put, *rest]) - len(put)

    def accepted(self) -> list[str]:
        """The terminals that may come next."""
        return [kind for kind in self.tables.actions[self.states[-1]] if self.shifts((kind,))]

    def new_line(self) -> bool:
        """Whether the token that does not fit begins a line."""
        return "\n" in self.source.text[self.before.end : self.ahead[0].start]

    def one_sign(self) -> bool:
        """Whether all that is wrong is a sign that has no meaning."""
        return self.ahead[0].kind == "STRAY" and self.reach(skip=1) >= 2

    def nested_module(self, item: Sequence[Token]) -> Token | None:
        """The `module` that begins inside of another one, and not where that should have ended.

        As the word is a name there, it may be the first of the tokens of the statement, `item`.
        """
        first = item[0] if item else self.ahead[0]
        if self.tables.language != "idsl" or first.text != "module" or not self.opened:
            return None
        deeper = self._indent(first.start) > self._indent(self.opened[0].start)
        return first if deeper else None

    def _indent(self, offset: int) -> int:
        """The blanks in front of the line at `offset`; a tab counts as one."""
        text = self.source.text
        start = max(text.rfind("\n", 0, offset), text.rfind("\r", 0, offset)) + 1
        line = text[start:offset]
        return len(line) - len(line.lstrip())

    def place(self) -> tuple[int, int]:
        """The characters to point at: the token that does not fit, or the end of what was read."""
        token = self.ahead[0]
        return (self.before.end,) * 2 if token.kind == END else (token.start, token.end)

    def closing(self) -> tuple[int, list[Token]]:
        """What lets the file end: how many states to keep, and the signs to put behind them."""
        states = list(self.states)
        while True:
            kinds = self._ends(states)
            if kinds is not None:
                at = self.before.end
                return len(states), [Token(kind, "", at, at) for kind in kinds]
            states.pop()
            while states[-1] not in self.tables.restarts:
                states.pop()

    def _ends(self, states: list[int]) -> list[str] | None:
        """The signs behind which the file may end; a `}` first, as each closes one more block."""
        kinds: list[str] = []
        while not self._shift(list(states), END):
            tried = ((kind, list(states)) for kind in ("RBRACE", "_SEMI"))
            fitting = next((one for one in tried if self._shift(one[1], one[0])), None)
            if fitting is None or len(kinds) > 2 * len(self.states):
                return None
            kinds.append(fitting[0])
            states = fitting[1]
        return kinds

    def _shift(self, states: list[int], kind: str) -> bool:
        actions, words = self.tables.actions, self.tables.words
        while True:
            row = actions[states[-1]]
            action = row.get(kind)
            if action is None and kind in words:
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


def expectation(situation: Situation, items: Mapping[str, str]) -> str:
    """What may come next, in the user's words; `items` names the kinds of items of a block."""
    accepted = situation.accepted()
    here = situation.tables.gotos[situation.states[-1]]
    words = [items[name] for name in here if name in items]
    if words:
        kinds = [kind for kind in accepted if kind == "RBRACE"]
    else:
        kinds = [kind for kind in accepted if kind not in _UNSAID]
        kinds = [kind for kind in kinds if kind not in _RARE] or kinds
    if kinds == ["ID"] and situation.before.kind == "NUMBER":
        return "a unit of time (`ms`, `s`, `min`, `h`)"
    texts = situation.tables.texts
    words += sorted(_NAMES[kind] for kind in kinds if kind in _NAMES)
    words += sorted(f"`{texts[kind]}`" for kind in kinds if kind in texts)
    return f"{', '.join(words[:-1])} or {words[-1]}" if len(words) > 1 else "".join(words)


def quote(token: Token) -> str:
    """The token as shown in a message."""
    if token.kind == END:
        return "the end of the file"
    text = token.text if len(token.text) <= 30 else token.text[:27] + "…"
    return f"`{text}`" if "`" not in text else text

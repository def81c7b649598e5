"""Constraints of arbitrated connections: boolean expressions over events.

    expression := term (("or" | "||") term)*
    term       := factor (("and" | "&&") factor)*
    factor     := ("not" | "!") factor | "(" expression ")" | "true" | "false" | EVENT

In: a text such as `e_face and not e_stop`. Out: a `Constraint` that is evaluated for a set of
active events, or a `ConstraintError` with its place in the text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

EVENT_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
MAX_LENGTH = 1000
"""Characters of a constraint."""
MAX_DEPTH = 50
"""Nested parentheses and negations."""
MAX_EVENTS = 16
"""Events of which `find_conflict` enumerates all combinations."""

Table: TypeAlias = int
"""The values of an expression for all combinations of events: bit i is that of combination i."""
Columns: TypeAlias = dict[str, Table]
Expression: TypeAlias = Callable[[Columns, Table], Table]
"""From the tables of the events, and the table that is true everywhere, to that of the result."""

_TOKEN = re.compile(r"\s*(?:([A-Za-z_][A-Za-z0-9_]*)|(&&|\|\||!(?!=)|[()]))")
_OPERATORS = {"&&": "and", "||": "or", "!": "not"}
_WORDS = frozenset({"and", "or", "not", "true", "false"})


class ConstraintError(ValueError):
    """An invalid constraint: what is wrong at `text[start:end]`, and how to fix it."""

    def __init__(self, message: str, start: int, end: int, help_text: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.start = start
        self.end = end
        self.help = help_text


class TooManyEvents(ValueError):
    """Two constraints have more than `MAX_EVENTS` events: they are not compared."""


@dataclass(frozen=True, slots=True)
class Constraint:
    """A parsed constraint. `events` are the names in it, sorted."""

    text: str
    events: tuple[str, ...]
    expression: Expression = field(compare=False, repr=False)

    def evaluate(self, active: Collection[str]) -> bool:
        """Whether it is true while exactly the events `active` are."""
        return bool(self.expression({name: int(name in active) for name in self.events}, 1))

    def sometimes_true(self) -> bool:
        """Whether any combination of events makes it true. Raises `TooManyEvents`."""
        columns, everywhere = _all_combinations(self.events)
        return bool(self.expression(columns, everywhere))


@dataclass(frozen=True, slots=True)
class _Token:
    """`word` is a keyword, a parenthesis, an event, or "" at the end."""

    word: str
    start: int
    end: int
    is_event: bool = False


def parse_constraint(text: str) -> Constraint:
    """`text` as a constraint. Raises `ConstraintError`."""
    if len(text) > MAX_LENGTH:
        message = f"the constraint has {len(text)} characters; at most {MAX_LENGTH} are allowed"
        raise ConstraintError(message, MAX_LENGTH, len(text))
    parser = _ConstraintParser(_tokens(text))
    expression = parser.parse()
    return Constraint(text, tuple(sorted(parser.events)), expression)


def find_conflict(first: Constraint, second: Constraint) -> frozenset[str] | None:
    """The fewest events under which both are true; None if they exclude each other.

    Raises `TooManyEvents`.
    """
    events = sorted({*first.events, *second.events})
    columns, everywhere = _all_combinations(events)
    both = first.expression(columns, everywhere) & second.expression(columns, everywhere)
    if not both:
        return None
    combinations = (i for i in range(1 << len(events)) if both >> i & 1)
    fewest = min(combinations, key=int.bit_count)
    return frozenset(name for i, name in enumerate(events) if fewest >> i & 1)


def _all_combinations(events: Sequence[str]) -> tuple[Columns, Table]:
    """The truth table of `events`: a column for each; and the column that is true everywhere."""
    if len(events) > MAX_EVENTS:
        raise TooManyEvents(f"{len(events)} events; at most {MAX_EVENTS} are compared")
    size = 1 << len(events)
    everywhere = (1 << size) - 1
    columns = {}
    for i, name in enumerate(events):
        # Bit i of the combination's number: blocks of 2^i zeros and 2^i ones alternate.
        block = ((1 << (1 << i)) - 1) << (1 << i)
        columns[name] = everywhere // ((1 << (2 << i)) - 1) * block
    return columns, everywhere


def _tokens(text: str) -> list[_Token]:
    tokens = []
    position = 0
    end = len(text.rstrip())
    while position < end:
        match = _TOKEN.match(text, position)
        if match is None:
            start = position + len(text[position:]) - len(text[position:].lstrip())
            raise _unknown_character(text, start)
        word, sign = match.group(1), match.group(2)
        if word is None:
            tokens.append(_Token(_OPERATORS.get(sign, sign), match.start(2), match.end(2)))
        else:
            is_event = word.lower() not in _WORDS
            name = word if is_event else word.lower()
            tokens.append(_Token(name, match.start(1), match.end(1), is_event))
        position = match.end()
    tokens.append(_Token("", end, end))
    return tokens


def _unknown_character(text: str, start: int) -> ConstraintError:
    help_text = "write events with and, or, not and parentheses: e_face and not e_stop"
    character = text[start]
    if character in "&|":
        word = "and" if character == "&" else "or"
        return ConstraintError(f"`{character}` is no operator", start, start + 1, f"write `{word}`")
    if character in "=!<>":
        help_text = "an event is active or not; it has no value to compare"
    return ConstraintError(f"unexpected `{character}`", start, start + 1, help_text)


class _ConstraintParser:
    """Recursive descent over the tokens of one constraint."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens = tokens
        self._next = 0
        self._depth = 0
        self.events: set[str] = set()

    def parse(self) -> Expression:
        """The whole constraint. Raises `ConstraintError`."""
        expression = self._expression()
        token = self._peek()
        if token.word:
            raise self._unexpected_end_of_expression(token)
        return expression

    def _peek(self) -> _Token:
        return self._tokens[self._next]

    def _take(self) -> _Token:
        token = self._tokens[self._next]
        self._next += 1
        return token

    def _accepts(self, word: str) -> bool:
        token = self._peek()
        if token.is_event or token.word != word:
            return False
        self._next += 1
        return True

    def _expression(self) -> Expression:
        terms = [self._term()]
        while self._accepts("or"):
            terms.append(self._term())
        return terms[0] if len(terms) == 1 else _disjunction(terms)

    def _term(self) -> Expression:
        factors = [self._factor()]
        while self._accepts("and"):
            factors.append(self._factor())
        return factors[0] if len(factors) == 1 else _conjunction(factors)

    def _factor(self) -> Expression:
        token = self._peek()
        if token.is_event:
            self._take()
            self.events.add(token.word)
            return _event(token.word)
        if token.word in {"true", "false"}:
            self._take()
            return _constant(token.word == "true")
        if token.word not in {"not", "("}:
            raise self._missing_event(token)
        self._take()
        self._depth += 1
        if self._depth > MAX_DEPTH:
            message = f"more than {MAX_DEPTH} nested parentheses and negations"
            raise ConstraintError(message, token.start, token.end)
        expression = (
            _negation(self._factor()) if token.word == "not" else self._in_parentheses(token)
        )
        self._depth -= 1
        return expression

    def _in_parentheses(self, opening: _Token) -> Expression:
        expression = self._expression()
        if not self._accepts(")"):
            token = self._peek()
            if token.word:
                raise self._unexpected_end_of_expression(token)
            raise ConstraintError("this parenthesis is not closed", opening.start, opening.end)
        return expression

    def _unexpected_end_of_expression(self, token: _Token) -> ConstraintError:
        if token.word == ")":
            return ConstraintError("no parenthesis to close", token.start, token.end)
        return ConstraintError(
            f"`and` or `or` is missing before `{token.word}`", token.start, token.end
        )

    def _missing_event(self, token: _Token) -> ConstraintError:
        previous = self._tokens[self._next - 1] if self._next else None
        after = f" after `{previous.word}`" if previous else ""
        if not token.word:
            where = previous or token
            return ConstraintError(f"an event is missing{after}", where.start, where.end)
        before = f" before `{token.word}`" if not after else ""
        return ConstraintError(f"an event is missing{after}{before}", token.start, token.end)


def _event(name: str) -> Expression:
    return lambda columns, _everywhere: columns[name]


def _constant(value: bool) -> Expression:
    return lambda _columns, everywhere: everywhere if value else 0


def _negation(operand: Expression) -> Expression:
    return lambda columns, everywhere: everywhere ^ operand(columns, everywhere)


def _conjunction(operands: Sequence[Expression]) -> Expression:
    def conjunction(columns: Columns, everywhere: Table) -> Table:
        result = everywhere
        for operand in operands:
            result &= operand(columns, everywhere)
        return result

    return conjunction


def _disjunction(operands: Sequence[Expression]) -> Expression:
    def disjunction(columns: Columns, everywhere: Table) -> Table:
        result = 0
        for operand in operands:
            result |= operand(columns, everywhere)
        return result

    return disjunction

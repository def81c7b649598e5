"""Reductions of an LR parser: what happens to the stack when a rule is complete.

In: the rules of a grammar, a builder, the stack. Out: one function for each rule, with everything
about the rule at hand: a file of 1000 lines takes ten thousand reductions.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.tables import Pick, Rule, Tables
from robocomp_dsl.syntax.languages.builder import Builder

StackEntry: TypeAlias = tuple[int, Any, int, int]
"""State, value of the symbol that led to it, and the range [start, end) of that symbol."""
Reduction: TypeAlias = Callable[[int], None]
"""Replaces the symbols of a rule by its result; that of an empty rule is at the given offset."""

_Leaf: TypeAlias = Callable[[Token], Node]
_Child: TypeAlias = tuple[int, _Leaf | None, bool]
"""A child: the index of its symbol (-1: absent), the function that builds a node of a token, and
whether it is a list whose items are the children."""


def prepare_reductions(
    tables: Tables, builder: Builder, findings: FileDiagnostics, stack: list[StackEntry]
) -> list[Reduction]:
    """The reductions of all rules, for one stack."""
    gotos = tables.gotos
    reductions: list[Reduction] = []
    for rule in tables.rules:
        call = getattr(builder, rule.method) if rule.method else None
        if rule.unwraps and rule.length == 1:
            reductions.append(_unwrap(rule, gotos, stack))
        elif rule.length:
            children = [_child(pick, builder) for pick in rule.picks]
            reductions.append(_replace(rule, children, call, gotos, findings, stack))
        else:
            reductions.append(_insert(rule, call, gotos, findings, stack))
    return reductions


def _child(pick: Pick, builder: Builder) -> _Child:
    return pick.symbol, builder.leaf(pick.terminal) if pick.terminal else None, pick.spliced


def _unwrap(rule: Rule, gotos: list[dict[str, int]], stack: list[StackEntry]) -> Reduction:
    """A rule whose only symbol is its result."""
    origin = rule.origin

    def reduce(_offset: int) -> None:
        _, value, start, end = stack.pop()
        stack.append((gotos[stack[-1][0]][origin], value, start, end))

    return reduce


def _insert(
    rule: Rule,
    call: Callable[..., Any] | None,
    gotos: list[dict[str, int]],
    findings: FileDiagnostics,
    stack: list[StackEntry],
) -> Reduction:
    """A rule without symbols; its children are absent."""
    origin, absent = rule.origin, [None] * len(rule.picks)

    def reduce(offset: int) -> None:
        value = call(Span(findings.region, offset, offset), *absent) if call else list(absent)
        stack.append((gotos[stack[-1][0]][origin], value, offset, offset))

    return reduce


def _replace(
    rule: Rule,
    picks: list[_Child],
    call: Callable[..., Any] | None,
    gotos: list[dict[str, int]],
    findings: FileDiagnostics,
    stack: list[StackEntry],
) -> Reduction:
    """A rule of one or more symbols."""
    origin, length = rule.origin, rule.length
    # The list of a repetition grows in place: copying it would take quadratic time.
    grows = bool(picks) and picks[0][2]
    first, rest = (picks[0][0], picks[1:]) if grows else (-1, picks)

    def reduce(_offset: int) -> None:
        symbols = stack[-length:]
        del stack[-length:]
        value = symbols[first][1] if grows else []
        for index, leaf, spliced in rest:
            if leaf:
                value.append(leaf(symbols[index][1]))
            elif spliced:
                value += symbols[index][1]
            else:
                value.append(symbols[index][1] if index >= 0 else None)
        start, end = symbols[0][2], symbols[-1][3]
        if call:
            value = call(Span(findings.region, start, end), *value)
        stack.append((gotos[stack[-1][0]][origin], value, start, end))

    return reduce

"""Constraints: parsing with located errors, evaluation, and the search for conflicts."""

from __future__ import annotations

from itertools import chain, combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.monitors.constraint import (
    ConstraintError,
    TooManyEvents,
    find_conflict,
    parse_constraint,
)

NAMES = ("e_a", "e_b", "e_c", "e_d")
ATOMS = st.sampled_from((*NAMES, "true", "false"))
TEXTS = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        inner.map(lambda text: f"not ({text})"),
        st.tuples(inner, inner).map(lambda pair: f"({pair[0]}) and ({pair[1]})"),
        st.tuples(inner, inner).map(lambda pair: f"({pair[0]}) or {pair[1]}"),
    ),
    max_leaves=8,
)


def subsets(names: tuple[str, ...]) -> list[frozenset[str]]:
    """All combinations of events, the smallest first."""
    sizes = range(len(names) + 1)
    return [frozenset(s) for s in chain.from_iterable(combinations(names, n) for n in sizes)]


def python_value(text: str, active: frozenset[str]) -> bool:
    """The value of a constraint as Python computes it."""
    values = {name: name in active for name in NAMES} | {"true": True, "false": False}
    return bool(eval(text, {"__builtins__": {}}, values))


@given(TEXTS)
def test_constraint_evaluates_as_python_does(text: str) -> None:
    constraint = parse_constraint(text)
    for active in subsets(NAMES):
        assert constraint.evaluate(active) == python_value(text, active)


@given(TEXTS, TEXTS)
def test_find_conflict_finds_the_fewest_events_or_proves_that_there_are_none(
    first: str, second: str
) -> None:
    conflicts = [s for s in subsets(NAMES) if python_value(first, s) and python_value(second, s)]
    found = find_conflict(parse_constraint(first), parse_constraint(second))
    if found is None:
        assert not conflicts
    else:
        assert found in conflicts
        assert len(found) == len(conflicts[0])


@given(TEXTS)
def test_constraint_is_sometimes_true_if_a_combination_satisfies_it(text: str) -> None:
    satisfied = any(python_value(text, active) for active in subsets(NAMES))
    assert parse_constraint(text).sometimes_true() == satisfied


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("a && !b || c", "(a and (not b)) or c"),
        ("NOT a OR b", "(not a) or b"),
        ("a or b and c", "a or (b and c)"),
        (" not not a ", "a"),
    ],
)
def test_constraint_operators_have_the_usual_precedence(text: str, same: str) -> None:
    left, right = parse_constraint(text), parse_constraint(same)
    for active in subsets(("a", "b", "c")):
        assert left.evaluate(active) == right.evaluate(active)


@pytest.mark.parametrize(
    ("text", "marked", "message"),
    [
        ("", "", "an event is missing"),
        ("e_a and", "and", "an event is missing after `and`"),
        ("and e_a", "and", "an event is missing before `and`"),
        ("e_a or or e_b", "or", "an event is missing after `or`"),
        ("e_a e_b", "e_b", "`and` or `or` is missing before `e_b`"),
        ("e_a not e_b", "not", "`and` or `or` is missing before `not`"),
        ("(e_a or e_b", "(", "this parenthesis is not closed"),
        ("(e_a e_b)", "e_b", "`and` or `or` is missing before `e_b`"),
        ("e_a)", ")", "no parenthesis to close"),
        ("e_a & e_b", "&", "`&` is no operator"),
        ("e_a == 1", "=", "unexpected `=`"),
        ("e_a != e_b", "!", "unexpected `!`"),
        ("e_a and 3", "3", "unexpected `3`"),
        ("not " * 60 + "e_a", "not", "more than 50 nested parentheses and negations"),
        ("e_a or " * 200 + "e_a", None, "the constraint has 1403 characters; at most 1000"),
    ],
)
def test_constraint_error_is_located(text: str, marked: str | None, message: str) -> None:
    with pytest.raises(ConstraintError) as caught:
        parse_constraint(text)
    error = caught.value
    assert message in error.message
    if marked is not None:
        assert text[error.start : error.end] == marked


@given(st.text(alphabet="ab()&|! notrue\n\t0=é", max_size=30))
def test_constraint_of_any_text_is_parsed_or_located(text: str) -> None:
    error = None
    try:
        constraint = parse_constraint(text)
    except ConstraintError as caught:
        error = caught
    if error is None:
        assert constraint.text == text
    else:
        assert 0 <= error.start <= error.end <= len(text)
        assert error.message


def test_find_conflict_compares_sixteen_events_but_no_more() -> None:
    names = [f"e_{i}" for i in range(17)]
    everything = parse_constraint(" and ".join(names[:16]))
    nothing = parse_constraint("not e_0")
    assert find_conflict(everything, nothing) is None
    assert find_conflict(everything, parse_constraint("e_3")) == frozenset(names[:16])
    with pytest.raises(TooManyEvents, match="17 events; at most 16"):
        find_conflict(everything, parse_constraint("e_16"))

"""What a state diagram says: the names in its boxes and the words beside its lines.

In: a state machine. Out: texts.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.model.statemachine import State, StateMachine, Transition

Pair: TypeAlias = tuple[str, str]
"""Source and target of transitions; those that share both are one line."""

LONGEST_LABEL = 40
"""Characters beside a line; the table below the diagram has all of them."""


def shown(state: State) -> str:
    """The name of a state in its box; a history has the sign that it has in UML before it."""
    sign = {"shallow": "H ", "deep": "H* "}.get(state.history, "")
    mark = " (parallel)" if state.parallel and state.inside else ""
    return f"{sign}{state.name}{mark}"


def lines_of(machine: StateMachine) -> dict[Pair, tuple[str, ...]]:
    """What is said beside each line; also of those from a history to where it leads at first."""
    found: dict[Pair, list[str]] = {}
    for one in machine.transitions:
        words = label(one)
        for target in one.targets or (one.source,):
            found.setdefault((one.source, target), []).extend([words] if words else [])
    todo = list(machine.states)
    while todo:
        state = todo.pop()
        todo += state.inside
        if state.history:
            found |= {(state.name, target): [] for target in state.start}
    return {pair: tuple(said) for pair, said in found.items()}


def label(one: Transition) -> str:
    """What fires a transition; nothing for the event that has its name from the two states."""
    default = one.event.removeprefix("t_") == f"{one.source}_to_{one.target}"
    after = "" if one.after_s is None else f"after {one.after_s:g} s"
    fired = " or ".join(part for part in ("" if default else one.event, after) if part)
    cond = f"[{' '.join(one.cond.split())}]" if one.cond else ""
    stays = "" if one.targets else "(stays)"
    said = " ".join(part for part in (fired, cond, stays) if part)
    return said if len(said) <= LONGEST_LABEL else f"{said[: LONGEST_LABEL - 1]}…"

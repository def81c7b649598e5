"""The labels of a state diagram: names of states and labels of transitions.

In: a state machine. Out: texts.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.model.statemachine import State, StateMachine, Transition

StatePair: TypeAlias = tuple[str, str]
"""Source and target of transitions; transitions with the same pair are one line."""

MAX_LABEL_LENGTH = 40
"""Characters of a label; the table below the diagram has the full text."""


def state_label(state: State) -> str:
    """The label of a state; a history state has UML's prefix H or H*."""
    sign = {"shallow": "H ", "deep": "H* "}.get(state.history, "")
    mark = " (parallel)" if state.parallel and state.substates else ""
    return f"{sign}{state.name}{mark}"


def transition_labels(machine: StateMachine) -> dict[StatePair, tuple[str, ...]]:
    """The labels of each line, including lines from history states to their defaults."""
    labels: dict[StatePair, list[str]] = {}
    for transition in machine.transitions:
        words = transition_label(transition)
        for target in transition.targets or (transition.source,):
            labels.setdefault((transition.source, target), []).extend([words] if words else [])
    todo = list(machine.states)
    while todo:
        state = todo.pop()
        todo += state.substates
        if state.history:
            labels |= {(state.name, target): [] for target in state.start}
    return {pair: tuple(lines) for pair, lines in labels.items()}


def transition_label(transition: Transition) -> str:
    """The trigger and condition of a transition; default event names are left out."""
    default = transition.event.removeprefix("t_") == f"{transition.source}_to_{transition.target}"
    after = "" if transition.after_s is None else f"after {transition.after_s:g} s"
    fired = " or ".join(part for part in ("" if default else transition.event, after) if part)
    cond = f"[{' '.join(transition.cond.split())}]" if transition.cond else ""
    stays = "" if transition.targets else "(stays)"
    message = " ".join(part for part in (fired, cond, stays) if part)
    return message if len(message) <= MAX_LABEL_LENGTH else f"{message[: MAX_LABEL_LENGTH - 1]}…"

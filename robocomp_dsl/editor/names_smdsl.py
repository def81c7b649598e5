"""The names in a state machine: the machine, its states, and the events that its ways wait for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check import check_machine
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import ast_smdsl as ast
from robocomp_dsl.syntax import parse_smdsl
from robocomp_dsl.syntax.ast_base import Name


@dataclass(frozen=True, slots=True, eq=False)
class StateInMachine:
    """A state with the ways that lead to it and from it."""

    state: State
    ways: tuple[Transition, ...]

    @property
    def doc(self) -> str:
        """The doc comment of the state."""
        return self.state.doc


@dataclass(frozen=True, slots=True, eq=False)
class Event:
    """A name that ways wait for; `ways` are all of them."""

    name: str
    ways: tuple[Transition, ...]


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_smdsl)
    tree = file.tree.machine
    if tree is None:
        return file.source, file.tree.complete, []
    machine = check_machine(path, workspace, Report())
    place = Symbol(tree.name.text, "statemachine", tree.name.span, machine)
    names = _Names((tree, *file.tree.substates), machine)
    return file.source, file.tree.complete, [Mention(place.span, place, declares=True), *names]


class _Names:
    """The mentions in all blocks of a file; of two states with one name the first is meant."""

    def __init__(self, blocks: tuple[ast.Block, ...], machine: StateMachine | None) -> None:
        self._blocks = blocks
        self._machine = machine
        self._events: dict[str, Symbol] = {}
        things = {one.span.start: one for one in machine.every_state()} if machine else {}
        self._states: dict[str, Symbol] = {}
        for block in blocks:
            for name in block.all_states:
                thing = self._thing(things.get(name.span.start))
                made = Symbol(name.text, "state", name.span, thing, self._container())
                self._states.setdefault(name.text, made)

    def __iter__(self) -> Iterator[Mention]:
        for block in self._blocks:
            for name in block.all_states:
                symbol = self._states[name.text]
                yield Mention(name.span, symbol, declares=symbol.span == name.span)
            if isinstance(block, ast.Substates):
                yield from self._state(block.name)
            for edge in block.edges:
                for name in (edge.source, *edge.targets):
                    yield from self._state(name)
                if edge.event:
                    yield self._event(edge.event)

    def _container(self) -> str:
        return self._blocks[0].name.text

    def _ways(self) -> tuple[Transition, ...]:
        return self._machine.transitions if self._machine else ()

    def _thing(self, state: State | None) -> StateInMachine | None:
        if state is None:
            return None
        ways = (one for one in self._ways() if state.name in (one.source, one.target))
        return StateInMachine(state, tuple(ways))

    def _state(self, name: Name) -> Iterator[Mention]:
        if name.text in self._states:
            yield Mention(name.span, self._states[name.text])

    def _event(self, name: Name) -> Mention:
        """An event is declared by whoever names it first."""
        first = self._events.get(name.text)
        if first is None:
            ways = tuple(one for one in self._ways() if one.event == name.text)
            first = Symbol(name.text, "event", name.span, Event(name.text, ways), self._container())
            self._events[name.text] = first
            return Mention(name.span, first, declares=True)
        return Mention(name.span, first)

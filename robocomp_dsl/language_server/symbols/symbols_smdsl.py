"""Indexer of SMDSL files: the state machine, its states, and the events of its transitions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.passes import check_state_machine
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import smdsl as ast
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.parse import parse_smdsl


@dataclass(frozen=True, slots=True, eq=False)
class StateInfo:
    """A state with its incoming and outgoing transitions."""

    state: State
    transitions: tuple[Transition, ...]

    @property
    def doc(self) -> str:
        """The doc comment of the state."""
        return self.state.doc


@dataclass(frozen=True, slots=True, eq=False)
class EventInfo:
    """An event with all transitions that it triggers."""

    name: str
    transitions: tuple[Transition, ...]


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_smdsl)
    tree = file.tree.machine
    if tree is None:
        return file.source, file.tree.complete, []
    machine = check_state_machine(path, workspace, Report())
    symbol = Symbol(tree.name.text, "statemachine", tree.name.span, machine)
    own = Occurrence(symbol.span, symbol, declares=True)
    collector = _OccurrenceCollector((tree, *file.tree.substates), machine)
    return file.source, file.tree.complete, [own, *collector]


class _OccurrenceCollector:
    """The occurrences in all blocks of a file; the first of two states with one name counts."""

    def __init__(self, blocks: tuple[ast.Block, ...], machine: StateMachine | None) -> None:
        self._blocks = blocks
        self._machine = machine
        self._events: dict[str, Symbol] = {}
        states = {state.span.start: state for state in machine.all_states()} if machine else {}
        self._states: dict[str, Symbol] = {}
        for block in blocks:
            for name in block.all_states:
                info = self._state_info(states.get(name.span.start))
                symbol = Symbol(name.text, "state", name.span, info, self._container())
                self._states.setdefault(name.text, symbol)

    def __iter__(self) -> Iterator[Occurrence]:
        for block in self._blocks:
            for name in block.all_states:
                symbol = self._states[name.text]
                yield Occurrence(name.span, symbol, declares=symbol.span == name.span)
            if isinstance(block, ast.Substates):
                yield from self._state_occurrences(block.name)
            for edge in block.edges:
                for name in (edge.source, *edge.targets):
                    yield from self._state_occurrences(name)
                if edge.event:
                    yield self._event_occurrence(edge.event)

    def _container(self) -> str:
        return self._blocks[0].name.text

    def _transitions(self) -> tuple[Transition, ...]:
        return self._machine.transitions if self._machine else ()

    def _state_info(self, state: State | None) -> StateInfo | None:
        if state is None:
            return None
        own = (t for t in self._transitions() if state.name in (t.source, t.target))
        return StateInfo(state, tuple(own))

    def _state_occurrences(self, name: Name) -> Iterator[Occurrence]:
        if name.text in self._states:
            yield Occurrence(name.span, self._states[name.text])

    def _event_occurrence(self, name: Name) -> Occurrence:
        """The first occurrence of an event declares it."""
        first = self._events.get(name.text)
        if first is None:
            info = EventInfo(
                name.text, tuple(t for t in self._transitions() if t.event == name.text)
            )
            first = Symbol(name.text, "event", name.span, info, self._container())
            self._events[name.text] = first
            return Occurrence(name.span, first, declares=True)
        return Occurrence(name.span, first)

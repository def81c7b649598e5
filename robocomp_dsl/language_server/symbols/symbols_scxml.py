"""Indexer of SCXML files: states, the attributes that refer to them, and event names."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.states.scxml_syntax import local_name
from robocomp_dsl.check.states.scxml_tags import STATES
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements, unquoted_span
from robocomp_dsl.language_server.symbols.symbols_smdsl import EventInfo, StateInfo
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.parse import parse_scxml

STATE_ATTRIBUTES = {
    "scxml": ("initial",),
    "state": ("initial",),
    "parallel": ("initial",),
    "transition": ("target",),
}
"""Tag to its attributes that list states."""
_EVENT_TAGS = ("transition", "raise", "send")
_WORD = re.compile(r"\S+")


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_scxml)
    model = check_file(path, workspace, Report())
    machine = model if isinstance(model, StateMachine) else None
    tags = list(elements(file.tree.root))
    states = _state_symbols(tags, machine, path.stem)
    occurrences = list(_state_occurrences(tags, states))
    occurrences += _event_occurrences(tags, machine, path.stem)
    return file.source, file.tree.complete, occurrences


def listed_words(element: Element, name: str) -> Iterator[tuple[Span, str]]:
    """The words in an attribute's value, each with its span."""
    attribute = element.get(name)
    if attribute is None:
        return
    span = unquoted_span(attribute.value)
    for word in _WORD.finditer(span.text):
        start = span.start + word.start()
        yield span.source.span(start, start + len(word[0])), word[0]


def _state_symbols(
    tags: list[Element], machine: StateMachine | None, container: str
) -> dict[str, Symbol]:
    """The symbol of each state by id; for a duplicate id the first state counts."""
    transitions = machine.transitions if machine else ()
    states = {state.name: state for state in machine.all_states()} if machine else {}
    symbols: dict[str, Symbol] = {}
    for element in tags:
        if local_name(element) in STATES:
            for span, name in listed_words(element, "id"):
                state = states.get(name)
                own = tuple(t for t in transitions if name in (t.source, t.target, *t.others))
                info = StateInfo(state, own) if state else None
                symbols.setdefault(name, Symbol(name, "state", span, info, container))
    return symbols


def _state_occurrences(tags: list[Element], states: dict[str, Symbol]) -> Iterator[Occurrence]:
    for element in tags:
        if local_name(element) in STATES:
            for span, name in listed_words(element, "id"):
                yield Occurrence(span, states[name], declares=states[name].span == span)
        for attribute in STATE_ATTRIBUTES.get(local_name(element), ()):
            for span, name in listed_words(element, attribute):
                if name in states:
                    yield Occurrence(span, states[name])


def _event_occurrences(
    tags: list[Element], machine: StateMachine | None, container: str
) -> Iterator[Occurrence]:
    """The event names, without patterns such as `door.*`."""
    symbols: dict[str, Symbol] = {}
    for element in tags:
        for span, name in (
            listed_words(element, "event") if local_name(element) in _EVENT_TAGS else ()
        ):
            if "*" in name:
                continue
            first = name not in symbols
            if first:
                transitions = machine.transitions if machine else ()
                own = tuple(t for t in transitions if name in t.event.split())
                symbols[name] = Symbol(name, "event", span, EventInfo(name, own), container)
            yield Occurrence(span, symbols[name], declares=first)

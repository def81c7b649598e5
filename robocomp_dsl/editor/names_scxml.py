"""The names in an SCXML file: its states, where they are led to, and the events by name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check import check_file
from robocomp_dsl.check.scxml_form import local
from robocomp_dsl.check.scxml_tags import STATES
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.editor.names_innermodel import elements, inside_quotes
from robocomp_dsl.editor.names_smdsl import Event, StateInMachine
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import parse_scxml
from robocomp_dsl.syntax.ast_innermodel import Element

LEADS = {
    "scxml": ("initial",),
    "state": ("initial",),
    "parallel": ("initial",),
    "transition": ("target",),
}
"""Attributes that list states, by their tag."""
_EVENTS = ("transition", "raise", "send")
_WORD = re.compile(r"\S+")


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_scxml)
    made = check_file(path, workspace, Report())
    machine = made if isinstance(made, StateMachine) else None
    found = list(elements(file.tree.root))
    states = _states(found, machine, path.stem)
    mentions = list(_mentions(found, states))
    mentions += _events(found, machine, path.stem)
    return file.source, file.tree.complete, mentions


def words(element: Element, name: str) -> Iterator[tuple[Span, str]]:
    """The words that an attribute lists, each with its place."""
    attribute = element.get(name)
    if attribute is None:
        return
    span = inside_quotes(attribute.value)
    for word in _WORD.finditer(span.text):
        start = span.start + word.start()
        yield span.source.span(start, start + len(word[0])), word[0]


def _states(
    found: list[Element], machine: StateMachine | None, container: str
) -> dict[str, Symbol]:
    """The symbol of each state; of two with one id the first counts."""
    ways = machine.transitions if machine else ()
    things = {one.name: one for one in machine.every_state()} if machine else {}
    made: dict[str, Symbol] = {}
    for element in found:
        if local(element) in STATES:
            for span, name in words(element, "id"):
                thing = things.get(name)
                mine = tuple(w for w in ways if name in (w.source, w.target, *w.others))
                state = StateInMachine(thing, mine) if thing else None
                made.setdefault(name, Symbol(name, "state", span, state, container))
    return made


def _mentions(found: list[Element], states: dict[str, Symbol]) -> Iterator[Mention]:
    for element in found:
        if local(element) in STATES:
            for span, name in words(element, "id"):
                yield Mention(span, states[name], declares=states[name].span == span)
        for attribute in LEADS.get(local(element), ()):
            for span, name in words(element, attribute):
                if name in states:
                    yield Mention(span, states[name])


def _events(
    found: list[Element], machine: StateMachine | None, container: str
) -> Iterator[Mention]:
    """Events that are written out; patterns such as `door.*` stand for others."""
    made: dict[str, Symbol] = {}
    for element in found:
        for span, name in words(element, "event") if local(element) in _EVENTS else ():
            if "*" in name:
                continue
            first = name not in made
            if first:
                ways = machine.transitions if machine else ()
                thing = Event(name, tuple(w for w in ways if name in w.event.split()))
                made[name] = Symbol(name, "event", span, thing, container)
            yield Mention(span, made[name], declares=first)

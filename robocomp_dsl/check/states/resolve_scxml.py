"""Resolves the state machine of an SCXML file.

In: the tree. Out: a `StateMachine` of nested states, and diagnostics. Conditions and executable
content are stored as written.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.states.scxml_safe import check_runnable
from robocomp_dsl.check.states.scxml_syntax import check_elements, local_name
from robocomp_dsl.check.states.scxml_tags import ACTIONS, STATES
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.syntax.ast.base import Name, Text
from robocomp_dsl.syntax.ast.innermodel import Attribute, Element, File

MAX_DEPTH = 200
"""Maximum depth of nested elements, as in InnerModel."""


def resolve_scxml(file: Parsed[File], report: Report) -> StateMachine | None:
    """The machine of a file; None if it has none."""
    root = file.tree.root
    if root is None:
        return None
    if local_name(root) != "scxml":
        message = f"the root element is `<{root.tag.text}>`; it must be `<scxml>`"
        report.add(codes.SCXML_TAG, root.tag.span, message)
        return None
    if _too_deep(root, report):
        return None
    check_elements(root, report)
    check_runnable(root, report)
    return _Resolver(report).machine(file, root)


def _too_deep(root: Element, report: Report) -> bool:
    level = [root]
    for _ in range(MAX_DEPTH):
        level = [child for element in level for child in element.children]
    if level:
        message = f"elements are nested more than {MAX_DEPTH} deep"
        report.add(codes.STATES_TOO_DEEP, level[0].tag.span, message)
    return bool(level)


@dataclass(slots=True)
class _Resolver:
    report: Report
    names: dict[int, Name] = field(default_factory=dict)
    """The name of each state element, by the identity of the element."""
    around: dict[str, str] = field(default_factory=dict)
    """The parent state of each state; "" for the machine."""

    def machine(self, file: Parsed[File], root: Element) -> StateMachine:
        first: dict[str, Name] = {}
        self._name(root, "", first)
        name = root.get("name")
        data = "\n".join(child.span.text for child in _named(root, "datamodel", "script"))
        start = self._start(root, "")
        if not self._states_in(root):
            message = "the machine has no states"
            self.report.add(codes.NO_INITIAL_STATE, root.tag.span, message)
        return StateMachine(
            name=name.value.value if name else file.source.path.stem,
            path=file.source.path,
            span=name.value.span if name else root.tag.span,
            states=self._states(root, start),
            transitions=tuple(self._transitions(root)),
            start=start,
            language=_text(root, "datamodel"),
            data=data,
        )

    def _name(self, element: Element, parent: str, first: dict[str, Name]) -> None:
        """Name every state; a state without an id gets a name that is not a valid id."""
        for child in _named(element, *STATES):
            id_attribute = child.get("id")
            state_name = Name(child.tag.span, f"{local_name(child)}#{len(self.names) + 1}")
            if id_attribute and id_attribute.value.value.strip():
                state_name = Name(id_attribute.value.span, id_attribute.value.value.strip())
                earlier = first.setdefault(state_name.text, state_name)
                if earlier is not state_name:
                    report_duplicate(state_name, earlier, "state", self.report)
                    state_name = Name(state_name.span, f"{state_name.text}#{len(self.names) + 1}")
            self.names[id(child)] = state_name
            self.around[state_name.text] = parent
            self._name(child, state_name.text, first)

    def _states_in(self, element: Element) -> list[Element]:
        return list(_named(element, *STATES))

    def _states(self, element: Element, start: tuple[str, ...]) -> tuple[State, ...]:
        states = []
        at_first = {self._child_towards(name, element) for name in start}
        for child in self._states_in(element):
            name = self.names[id(child)]
            kind = local_name(child)
            inner = self._history(child) if kind == "history" else self._start(child, name.text)
            states.append(
                State(
                    name=name.text,
                    span=name.span,
                    initial=name.text in at_first and local_name(element) != "parallel",
                    final=kind == "final",
                    parallel=kind == "parallel",
                    substates=self._states(child, inner) if kind != "history" else (),
                    start=inner,
                    history=_text(child, "type") or "shallow" if kind == "history" else "",
                    entry=_content(child, "onentry"),
                    exit=_content(child, "onexit"),
                )
            )
        return tuple(states)

    def _child_towards(self, name: str, element: Element) -> str:
        """The state directly in `element` that is or holds the one called `name`."""
        within = self.names[id(element)].text if id(element) in self.names else ""
        while name and self.around.get(name, "") != within:
            name = self.around.get(name, "")
        return name

    # -- initial states -----------------------------------------------------------------------

    def _start(self, element: Element, name: str) -> tuple[str, ...]:
        """The initial states of an element: those that it names, else its first state."""
        inside = [state for state in self._states_in(element) if local_name(state) != "history"]
        if local_name(element) == "parallel" or not inside:
            self._no_start(element, inside)
            return ()
        written = element.get("initial")
        below = next(_named(element, "initial"), None)
        if written is None and below is not None:
            written = self._initial(below)
        if written is None:
            return (self.names[id(inside[0])].text,)
        targets = self._targets(written)  # empty for unknown names: any state may be initial
        return tuple(state for state in targets if self._is_within(state, name, written))

    def _no_start(self, element: Element, inside: list[Element]) -> None:
        written = element.get("initial")
        if written and inside:
            message = "parallel states are active simultaneously: none is initial"
            self.report.add(
                codes.PARALLEL_INITIAL_OR_FINAL, written.span, message, help="remove `initial`"
            )
        elif written:
            message = f"`{written.value.value:.60}` cannot be initial: there are no states here"
            self.report.add(codes.UNKNOWN_STATE, written.value.span, message)

    def _initial(self, element: Element) -> Attribute | None:
        transition = next(_named(element, "transition"), None)
        target = transition.get("target") if transition else None
        if target is None:
            message = "`<initial>` does not name an initial state"
            self.report.add(
                codes.NO_INITIAL_STATE,
                element.tag.span,
                message,
                help='write `<transition target="NAME"/>` in it',
            )
        return target

    def _is_within(self, name: str, parent: str, written: Attribute) -> bool:
        outer = self.around[name]
        while outer and outer != parent:
            outer = self.around[outer]
        if outer == parent:
            return True
        message = f"`{name}` is not inside `{parent}`"
        self.report.add(codes.UNKNOWN_STATE, written.value.span, message)
        return False

    def _history(self, element: Element) -> tuple[str, ...]:
        kind = element.get("type")
        if kind and kind.value.value not in ("shallow", "deep"):
            message = (
                f'the `type` of a history is `shallow` or `deep`, not "{kind.value.value:.40}"'
            )
            self.report.add(codes.SCXML_TAG, kind.value.span, message)
        transition = next(_named(element, "transition"), None)
        target = transition.get("target") if transition else None
        if target is not None:
            return tuple(self._targets(target))
        message = "the history has no default transition for the first entry"
        self.report.add(
            codes.NO_INITIAL_STATE,
            element.tag.span,
            message,
            help='write `<transition target="NAME"/>` in it',
        )
        return ()

    # -- transitions --------------------------------------------------------------------------

    def _transitions(self, element: Element) -> Iterator[Transition]:
        for child in self._states_in(element):
            if local_name(child) == "history":
                continue
            source = self.names[id(child)].text
            for transition in _named(child, "transition"):
                yield self._transition(source, transition, transition.get("target"))
            yield from self._transitions(child)

    def _transition(self, source: str, transition: Element, target: Attribute | None) -> Transition:
        targets = self._targets(target) if target else []
        event = " ".join(_text(transition, "event").split())
        if not event and not transition.get("cond") and not targets:
            message = f"the transition of `{source}` has no event, no condition and no target"
            self.report.add(codes.SCXML_TAG, transition.tag.span, message, label="it has no effect")
        return Transition(
            source=source,
            target=targets[0] if targets else "",
            event=event,
            span=target.value.span if target else transition.tag.span,
            others=tuple(targets[1:]),
            cond=_text(transition, "cond"),
            action=_actions([transition]),
            internal=_text(transition, "type") == "internal",
        )

    def _targets(self, written: Attribute) -> list[str]:
        """The states that an attribute lists; unknown ones are reported."""
        names = {name.text for name in self.names.values()}
        targets = []
        for word in _words(written.value):
            if word.text in names:
                targets.append(word.text)
                continue
            label = did_you_mean(word.text, names)
            message = f"unknown state `{word.text:.60}`"
            self.report.add(codes.UNKNOWN_STATE, word.span, message, label=label)
        if not targets and not written.value.value.strip():
            message = f"`{written.name.text}` names no state"
            self.report.add(codes.UNKNOWN_STATE, written.value.span, message)
        return targets


def _named(element: Element, *names: str) -> Iterator[Element]:
    """The children with these tags."""
    return (child for child in element.children if local_name(child) in names)


def _text(element: Element, name: str) -> str:
    attribute = element.get(name)
    return attribute.value.value.strip() if attribute else ""


def _content(element: Element, name: str) -> str:
    """The executable content of all children called `name`, as written."""
    return _actions(_named(element, name))


def _actions(blocks: Iterable[Element]) -> str:
    actions = (
        child for block in blocks for child in block.children if local_name(child) in ACTIONS
    )
    return "\n".join(child.span.text for child in actions)


def _words(text: Text) -> Iterator[Name]:
    """The words of a value with their spans, which are exact if no entity is used."""
    written = text.span.text
    at = 0
    for word in text.value.split():
        found = written.find(word, at)
        if found < 0:
            yield Name(text.span, word)
            continue
        at = found + len(word)
        start = text.span.start + found
        yield Name(text.span.source.span(start, start + len(word)), word)

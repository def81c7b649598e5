"""From the tree of an SCXML file to its state machine.

In: the tree. Out: a `StateMachine` of nested states, and findings about names. Conditions and
executable content stay as they are written.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.names import report_repeat
from robocomp_dsl.check.scxml_form import judge_form, local
from robocomp_dsl.check.scxml_safe import judge_safe
from robocomp_dsl.check.scxml_tags import ACTIONS, STATES
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.syntax.ast_base import Name, Text
from robocomp_dsl.syntax.ast_innermodel import Attribute, Element, File

MAX_DEPTH = 200
"""Of nested elements, as in InnerModel."""


def resolve_scxml(file: Parsed[File], report: Report) -> StateMachine | None:
    """The machine that a file describes; None where none is to be seen."""
    root = file.tree.root
    if root is None:
        return None
    if local(root) != "scxml":
        said = f"the outermost element is `<{root.tag.text}>`, it must be `<scxml>`"
        report.add(codes.SCXML_TAG, root.tag.span, said)
        return None
    if _too_deep(root, report):
        return None
    judge_form(root, report)
    judge_safe(root, report)
    return _Resolver(report).machine(file, root)


def _too_deep(root: Element, report: Report) -> bool:
    level = [root]
    for _ in range(MAX_DEPTH):
        level = [child for one in level for child in one.children]
    if level:
        said = f"elements are nested more than {MAX_DEPTH} deep"
        report.add(codes.DEEP_STATES, level[0].tag.span, said)
    return bool(level)


@dataclass(slots=True)
class _Resolver:
    report: Report
    names: dict[int, Name] = field(default_factory=dict)
    """What each state element is called, by its identity."""
    around: dict[str, str] = field(default_factory=dict)
    """The state around each state; "" for the machine."""

    def machine(self, file: Parsed[File], root: Element) -> StateMachine:
        first: dict[str, Name] = {}
        self._name(root, "", first)
        name = root.get("name")
        data = "\n".join(one.span.text for one in _named(root, "datamodel", "script"))
        start = self._start(root, "")
        if not self._states_in(root):
            said = "the machine has no states"
            self.report.add(codes.NO_INITIAL_STATE, root.tag.span, said)
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

    def _name(self, element: Element, around: str, first: dict[str, Name]) -> None:
        """Give every state its name; one without gets one that nobody can write."""
        for child in _named(element, *STATES):
            given = child.get("id")
            made = Name(child.tag.span, f"{local(child)}#{len(self.names) + 1}")
            if given and given.value.value.strip():
                made = Name(given.value.span, given.value.value.strip())
                earlier = first.setdefault(made.text, made)
                if earlier is not made:
                    report_repeat(made, earlier, "state", self.report)
                    made = Name(made.span, f"{made.text}#{len(self.names) + 1}")
            self.names[id(child)] = made
            self.around[made.text] = around
            self._name(child, made.text, first)

    def _states_in(self, element: Element) -> list[Element]:
        return list(_named(element, *STATES))

    def _states(self, element: Element, start: tuple[str, ...]) -> tuple[State, ...]:
        made = []
        at_first = {self._child_towards(name, element) for name in start}
        for child in self._states_in(element):
            name = self.names[id(child)]
            kind = local(child)
            inner = self._history(child) if kind == "history" else self._start(child, name.text)
            made.append(
                State(
                    name=name.text,
                    span=name.span,
                    initial=name.text in at_first and local(element) != "parallel",
                    final=kind == "final",
                    parallel=kind == "parallel",
                    inside=self._states(child, inner) if kind != "history" else (),
                    start=inner,
                    history=_text(child, "type") or "shallow" if kind == "history" else "",
                    entry=_content(child, "onentry"),
                    exit=_content(child, "onexit"),
                )
            )
        return tuple(made)

    def _child_towards(self, name: str, element: Element) -> str:
        """The state directly in `element` that is or holds the one called `name`."""
        within = self.names[id(element)].text if id(element) in self.names else ""
        while name and self.around.get(name, "") != within:
            name = self.around.get(name, "")
        return name

    # -- where it begins ----------------------------------------------------------------------

    def _start(self, element: Element, name: str) -> tuple[str, ...]:
        """What is entered with an element: as it says, else its first state."""
        inside = [one for one in self._states_in(element) if local(one) != "history"]
        if local(element) == "parallel" or not inside:
            self._no_start(element, inside)
            return ()
        written = element.get("initial")
        below = next(_named(element, "initial"), None)
        if written is None and below is not None:
            written = self._initial(below)
        if written is None:
            return (self.names[id(inside[0])].text,)
        found = self._targets(written)  # of a wrong name nothing is known: it may be any
        return tuple(one for one in found if self._is_within(one, name, written))

    def _no_start(self, element: Element, inside: list[Element]) -> None:
        written = element.get("initial")
        if written and inside:
            said = "parallel states are active together: none is the first"
            self.report.add(codes.PARALLEL_ENDS, written.span, said, help="leave out `initial`")
        elif written:
            said = f"`{written.value.value:.60}` cannot be the first: there are no states here"
            self.report.add(codes.UNKNOWN_STATE, written.value.span, said)

    def _initial(self, element: Element) -> Attribute | None:
        way = next(_named(element, "transition"), None)
        target = way.get("target") if way else None
        if target is None:
            said = "`<initial>` does not say which state comes first"
            self.report.add(
                codes.NO_INITIAL_STATE,
                element.tag.span,
                said,
                help='write `<transition target="NAME"/>` in it',
            )
        return target

    def _is_within(self, name: str, around: str, written: Attribute) -> bool:
        outer = self.around[name]
        while outer and outer != around:
            outer = self.around[outer]
        if outer == around:
            return True
        said = f"`{name}` is not inside `{around}`"
        self.report.add(codes.UNKNOWN_STATE, written.value.span, said)
        return False

    def _history(self, element: Element) -> tuple[str, ...]:
        kind = element.get("type")
        if kind and kind.value.value not in ("shallow", "deep"):
            said = f'the `type` of a history is `shallow` or `deep`, not "{kind.value.value:.40}"'
            self.report.add(codes.SCXML_TAG, kind.value.span, said)
        way = next(_named(element, "transition"), None)
        target = way.get("target") if way else None
        if target is not None:
            return tuple(self._targets(target))
        said = "the history does not say where it leads when there was nothing before"
        self.report.add(
            codes.NO_INITIAL_STATE,
            element.tag.span,
            said,
            help='write `<transition target="NAME"/>` in it',
        )
        return ()

    # -- ways ---------------------------------------------------------------------------------

    def _transitions(self, element: Element) -> Iterator[Transition]:
        for child in self._states_in(element):
            if local(child) == "history":
                continue
            source = self.names[id(child)].text
            for way in _named(child, "transition"):
                yield self._transition(source, way, way.get("target"))
            yield from self._transitions(child)

    def _transition(self, source: str, way: Element, target: Attribute | None) -> Transition:
        targets = self._targets(target) if target else []
        event = " ".join(_text(way, "event").split())
        if not event and not way.get("cond") and not targets:
            said = f"the transition of `{source}` has no event, no condition and no target"
            self.report.add(codes.SCXML_TAG, way.tag.span, said, label="nothing would happen")
        return Transition(
            source=source,
            target=targets[0] if targets else "",
            event=event,
            span=target.value.span if target else way.tag.span,
            others=tuple(targets[1:]),
            cond=_text(way, "cond"),
            action=_actions([way]),
            internal=_text(way, "type") == "internal",
        )

    def _targets(self, written: Attribute) -> list[str]:
        """The states that an attribute lists; unknown ones are reported, each at its place."""
        names = {name.text for name in self.names.values()}
        found = []
        for one in _words(written.value):
            if one.text in names:
                found.append(one.text)
                continue
            label = did_you_mean(one.text, names)
            said = f"there is no state `{one.text:.60}`"
            self.report.add(codes.UNKNOWN_STATE, one.span, said, label=label)
        if not found and not written.value.value.strip():
            said = f"`{written.name.text}` names no state"
            self.report.add(codes.UNKNOWN_STATE, written.value.span, said)
        return found


def _named(element: Element, *names: str) -> Iterator[Element]:
    """The children with these tags."""
    return (one for one in element.children if local(one) in names)


def _text(element: Element, name: str) -> str:
    found = element.get(name)
    return found.value.value.strip() if found else ""


def _content(element: Element, name: str) -> str:
    """The executable content of all children called `name`, as written."""
    return _actions(_named(element, name))


def _actions(blocks: Iterable[Element]) -> str:
    found = (one for block in blocks for one in block.children if local(one) in ACTIONS)
    return "\n".join(one.span.text for one in found)


def _words(text: Text) -> Iterator[Name]:
    """The words of a value with their places, which are exact where no entity is used."""
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

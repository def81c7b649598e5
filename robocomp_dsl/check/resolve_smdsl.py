"""From the tree of an SMDSL file to its state machine.

In: the tree. Out: a `StateMachine` of nested states, and findings about names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.names import report_repeat
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report, did_you_mean, nearest
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.syntax import ast_smdsl as ast
from robocomp_dsl.syntax.ast_base import Name

MAX_DEPTH = 200
"""Of blocks inside each other, as of the elements of SCXML."""


@dataclass(slots=True)
class Blocks:
    """The blocks of a file by the state they are inside ("" for the machine).

    `home` tells the block of every state; of a name that is used twice the first. `guessed` are
    the transitions with a slip in a name, as they are likely meant: no part of the machine, but
    what they lead to is not out of reach.
    """

    inside: dict[str, ast.Block] = field(default_factory=dict)
    home: dict[str, str] = field(default_factory=dict)
    guessed: list[Transition] = field(default_factory=list)

    def around(self, block: str) -> Iterator[str]:
        """The block, and those around it, innermost first."""
        while block:
            yield block
            block = self.home.get(block, "")
        yield ""


def resolve_smdsl(file: Parsed[ast.File], report: Report) -> tuple[StateMachine, Blocks] | None:
    """The machine that a file describes; None where none is to be seen."""
    machine = file.tree.machine
    if machine is None:
        return None
    blocks = _blocks(machine, file.tree.substates, report)
    transitions = tuple(
        one
        for name, block in blocks.inside.items()
        for one in _transitions(name, block, blocks, report)
    )
    made = StateMachine(
        machine.name.text,
        file.source.path,
        machine.name.span,
        _states("", blocks),
        transitions,
        machine.doc,
        start=(machine.initial.text,) if machine.initial else (),
    )
    return made, blocks


def _blocks(machine: ast.Machine, substates: tuple[ast.Substates, ...], report: Report) -> Blocks:
    made = Blocks({"": machine})
    names: dict[str, Name] = {}
    for block in (machine, *substates):
        home = "" if block is machine else block.name.text
        for state in block.all_states:
            first = names.setdefault(state.text, state)
            if first is not state:
                report_repeat(state, first, "state", report)
            else:
                made.home[state.text] = home
    for block in substates:
        earlier = made.inside.setdefault(block.name.text, block)
        if block.name.text not in names:
            del made.inside[block.name.text]
            _unknown(block.name, names, report)
        elif earlier is not block:
            report_repeat(block.name, earlier.name, "block", report)
    _cut_circles_and_depths(made, report)
    return made


def _cut_circles_and_depths(blocks: Blocks, report: Report) -> None:
    """A state inside itself, directly or not, and one inside too many others, come outermost."""
    told = False
    for name in list(blocks.inside):
        seen = {name}
        block = blocks.home.get(name, "") if name else ""
        while block and block not in seen and len(seen) < MAX_DEPTH:
            seen.add(block)
            block = blocks.home.get(block, "")
        if not block:
            continue
        at = blocks.inside[name].name.span
        blocks.home[name] = ""
        if block in seen:
            report.add(codes.UNKNOWN_STATE, at, f"`{name}` would be inside itself")
        elif not told:
            report.add(codes.DEEP_STATES, at, f"`{name}` is inside more than {MAX_DEPTH} states")
            told = True


def _states(block: str, blocks: Blocks) -> tuple[State, ...]:
    """The states of a block, with what is inside them."""
    tree = blocks.inside[block]
    docs = dict(tree.docs)
    made = []
    for name in tree.all_states:
        if blocks.home.get(name.text) != block:
            continue
        within = blocks.inside.get(name.text)
        made.append(
            State(
                name.text,
                name.span,
                initial=name is tree.initial,
                final=name is tree.end,
                parallel=isinstance(within, ast.Substates) and within.parallel,
                inside=_states(name.text, blocks) if within else (),
                doc=docs.get(name.text, ""),
                start=_start(within),
            )
        )
    return tuple(made)


def _start(block: ast.Block | None) -> tuple[str, ...]:
    return (block.initial.text,) if block and block.initial else ()


def _transitions(
    block: str, tree: ast.Block, blocks: Blocks, report: Report
) -> Iterator[Transition]:
    allowed = set(blocks.around(block))
    for edge in tree.edges:
        source = _meant(edge.source, {block}, tree, blocks, report)
        for written in edge.targets:
            target = _meant(written, allowed, tree, blocks, report)
            if not target or not source:
                continue
            event = edge.event.text if edge.event else f"t_{source}_to_{target}"
            after = edge.after.seconds if edge.after else None
            if edge.after and not edge.event:
                event = ""
            made = Transition(source, target, event, written.span, after, edge.doc)
            if (source, target) == (edge.source.text, written.text):
                yield made
            else:
                blocks.guessed.append(made)


def _meant(
    name: Name, allowed: set[str], tree: ast.Block, blocks: Blocks, report: Report
) -> str | None:
    """The state called `name`; of an unknown name the state that is likely meant."""
    home = blocks.home.get(name.text)
    if home in allowed:
        return name.text
    if home is None:
        _unknown(name, blocks.home, report, tree)
        return nearest(name.text, [one for one, at in blocks.home.items() if at in allowed])
    block = blocks.inside.get(home)  # not there for a block that belongs to no state
    where = f"inside `{home}`" if home else "outside of this block"
    report.add(
        codes.UNKNOWN_STATE,
        name.span,
        f"the state `{name.text}` is {where}",
        notes=[Note(block.name.span, "it belongs to this block")] if block else [],
        help=f"write the transition in the block of `{home}`" if home else "",
    )
    return None


def _unknown(
    name: Name, known: Mapping[str, object], report: Report, tree: ast.Block | None = None
) -> None:
    """Report a name of nothing; where nothing like it is known, it may be missing in `tree`."""
    guess = did_you_mean(name.text, known)
    missing = tree is not None and not guess
    report.add(
        codes.UNKNOWN_STATE,
        name.span,
        f"there is no state `{name.text}`",
        label=guess,
        help="list it under `states`" if missing else "",
        fix=_listed(name, tree.states) if tree is not None and missing else None,
    )


def _listed(name: Name, states: Sequence[Name]) -> Fix | None:
    if not states:
        return None
    last = states[-1].span
    edit = Edit(last.part(last.end, last.end), f", {name.text}")
    return Fix(f"add `{name.text}` to the states", (edit,))

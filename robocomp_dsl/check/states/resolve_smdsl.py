"""Resolves the state machine of an SMDSL file.

In: the tree. Out: a `StateMachine` of nested states, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report, nearest
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.syntax.ast import smdsl as ast
from robocomp_dsl.syntax.ast.base import Name

MAX_DEPTH = 200
"""Maximum depth of nested blocks, as in SCXML."""


@dataclass(slots=True)
class Blocks:
    """The blocks of a file by their parent state ("" for the machine).

    `block_of` maps every state to its block, `names` to its declaration; the first one if a name is
    repeated. `guessed` are
    corrected transitions with a misspelled name: they are not part of the machine, but their
    targets count as reachable.
    """

    by_parent: dict[str, ast.Block] = field(default_factory=dict)
    block_of: dict[str, str] = field(default_factory=dict)
    names: dict[str, Name] = field(default_factory=dict)
    guessed: list[Transition] = field(default_factory=list)

    def ancestors(self, block: str) -> Iterator[str]:
        """The block and its enclosing blocks, innermost first."""
        while block:
            yield block
            block = self.block_of.get(block, "")
        yield ""


def resolve_smdsl(file: Parsed[ast.File], report: Report) -> tuple[StateMachine, Blocks] | None:
    """The machine of a file; None if it has none."""
    machine = file.tree.machine
    if machine is None:
        return None
    blocks = _blocks(machine, file.tree.substates, report)
    transitions = tuple(
        transition
        for name, block in blocks.by_parent.items()
        for transition in _transitions(name, block, blocks, report)
    )
    state_machine = StateMachine(
        machine.name.text,
        file.source.path,
        machine.name.span,
        _states("", blocks),
        transitions,
        machine.doc,
        start=(machine.initial.text,) if machine.initial else (),
    )
    return state_machine, blocks


def _blocks(machine: ast.Machine, substates: tuple[ast.Substates, ...], report: Report) -> Blocks:
    blocks = Blocks({"": machine})
    names = blocks.names
    for block in (machine, *substates):
        home = "" if block is machine else block.name.text
        for state in block.all_states:
            first = names.setdefault(state.text, state)
            if first is not state:
                report_duplicate(state, first, "state", report)
            else:
                blocks.block_of[state.text] = home
    for block in substates:
        earlier = blocks.by_parent.setdefault(block.name.text, block)
        if block.name.text not in names:
            del blocks.by_parent[block.name.text]
            _report_unknown(block.name, blocks, report)
        elif earlier is not block:
            report_duplicate(block.name, earlier.name, "block", report)
    _cut_cycles(blocks, report)
    return blocks


def _cut_cycles(blocks: Blocks, report: Report) -> None:
    """Report states nested in themselves or too deeply, and move them to the top level."""
    reported = False
    for name in list(blocks.by_parent):
        seen = {name}
        block = blocks.block_of.get(name, "") if name else ""
        while block and block not in seen and len(seen) < MAX_DEPTH:
            seen.add(block)
            block = blocks.block_of.get(block, "")
        if not block:
            continue
        at = blocks.by_parent[name].name.span
        blocks.block_of[name] = ""
        if block in seen:
            report.add(codes.UNKNOWN_STATE, at, f"`{name}` is nested in itself")
        elif not reported:
            report.add(codes.STATES_TOO_DEEP, at, f"`{name}` is nested more than {MAX_DEPTH} deep")
            reported = True


def _states(block: str, blocks: Blocks) -> tuple[State, ...]:
    """The states of a block with their substates."""
    tree = blocks.by_parent[block]
    docs = dict(tree.state_docs)
    states = []
    for name in tree.all_states:
        if blocks.block_of.get(name.text) != block:
            continue
        within = blocks.by_parent.get(name.text)
        states.append(
            State(
                name.text,
                name.span,
                initial=name is tree.initial,
                final=name is tree.end,
                parallel=isinstance(within, ast.Substates) and within.parallel,
                substates=_states(name.text, blocks) if within else (),
                doc=docs.get(name.text, ""),
                start=_start(within),
            )
        )
    return tuple(states)


def _start(block: ast.Block | None) -> tuple[str, ...]:
    return (block.initial.text,) if block and block.initial else ()


def _transitions(
    block: str, tree: ast.Block, blocks: Blocks, report: Report
) -> Iterator[Transition]:
    allowed = set(blocks.ancestors(block))
    for edge in tree.edges:
        source = _resolve_state(edge.source, {block}, tree, blocks, report)
        for written in edge.targets:
            target = _resolve_state(written, allowed, tree, blocks, report)
            if not target or not source:
                continue
            event = edge.event.text if edge.event else f"t_{source}_to_{target}"
            after = edge.after.seconds if edge.after else None
            if edge.after and not edge.event:
                event = ""
            transition = Transition(source, target, event, written.span, after, edge.doc)
            if (source, target) == (edge.source.text, written.text):
                yield transition
            else:
                blocks.guessed.append(transition)


def _resolve_state(
    name: Name, allowed: set[str], tree: ast.Block, blocks: Blocks, report: Report
) -> str | None:
    """The state called `name`; for an unknown name the closest known state."""
    home = blocks.block_of.get(name.text)
    if home in allowed:
        return name.text
    if home is None:
        _report_unknown(name, blocks, report, tree)
        return nearest(name.text, [state for state, at in blocks.block_of.items() if at in allowed])
    block = blocks.by_parent.get(home)  # None for a block without a parent state
    where = f"inside `{home}`" if home else "outside of this block"
    report.add(
        codes.UNKNOWN_STATE,
        name.span,
        f"the state `{name.text}` is {where}",
        notes=[Note(block.name.span, "declared in this block")] if block else [],
        help=f"write the transition in the block of `{home}`" if home else "",
    )
    return None


def _report_unknown(
    name: Name, blocks: Blocks, report: Report, tree: ast.Block | None = None
) -> None:
    """Report an unknown state; the fix is a similar name, or adds it to the states of `tree`."""
    report_unknown_name(
        report,
        codes.UNKNOWN_STATE,
        name,
        f"unknown state `{name.text}`",
        blocks.names,
        "list it under `states`" if tree else "",
        declared=[state.span for state in blocks.names.values()],
        fix=_list_state_fix(name, tree.states) if tree else None,
    )


def _list_state_fix(name: Name, states: Sequence[Name]) -> Fix | None:
    if not states:
        return None
    last = states[-1].span
    edit = Edit(last.subspan(last.end, last.end), f", {name.text}")
    return Fix(f"add `{name.text}` to the states", (edit,))

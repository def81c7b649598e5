"""Completion of SMDSL files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.syntax.ast import smdsl as ast
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.languages.builder import TIME_UNITS

_DECLARING = ("STATES", "INITIAL_STATE", "END_STATE")
_TRANSITIONS = ("TRANSITIONS", "OLD_TRANSITIONS")


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """States, events and units of time."""
    kinds = [token.kind for token in context.statement]
    trees = [checked.tree for checked in session.checks_for_completion(context.path)]
    files = [tree for tree in trees if isinstance(tree, ast.File)]
    blocks = [b for f in files for b in ((f.machine,) if f.machine else ()) + f.substates]
    if context.previous_kind == "ON":
        events = (edge.event for block in blocks for edge in block.edges)
        kind = lsp.CompletionItemKind.Event
        yield from (CompletionCandidate(event.text, kind, "event") for event in events if event)
    elif context.previous_kind == "NUMBER" and "AFTER" in kinds:
        yield from value_candidates(*TIME_UNITS)
    elif kinds == ["COLON"]:
        described = {block.name.text for block in blocks}
        yield from _states(blocks, None, without=described)
    elif context.block_kind in _TRANSITIONS:
        yield from _transition_states(blocks, context)
    elif set(kinds[:1]) & set(_DECLARING) and (kinds[1:] == [] or kinds[-1] == "COMMA"):
        yield from _undeclared(blocks, _block_state(context.blocks[-1:]))


def _transition_states(
    blocks: Sequence[ast.Block], context: CompletionContext
) -> Iterator[CompletionCandidate]:
    """The possible sources or targets of a transition."""
    parent = _block_state(context.blocks[-2:-1])
    if not context.statement:
        yield from _states(blocks, {parent})
    elif context.previous_kind in ("__ANON_0", "COMMA"):
        yield from _states(blocks, _ancestors(blocks, parent))


def _block_state(opened: Sequence[Sequence[Token]]) -> str:
    """The state that a block describes; an empty string for the state machine."""
    tokens = opened[0] if opened else ()
    has_name = len(tokens) > 1 and tokens[0].kind == "COLON"
    return tokens[1].text if has_name else ""


def _parent_state(block: ast.Block) -> str:
    return block.name.text if isinstance(block, ast.Substates) else ""


def _ancestors(blocks: Sequence[ast.Block], name: str) -> set[str]:
    """The state `name` and its ancestors."""
    parents = {state.text: _parent_state(block) for block in blocks for state in block.all_states}
    ancestors = {""}
    while name not in ancestors:
        ancestors.add(name)
        name = parents.get(name, "")
    return ancestors


def _states(
    blocks: Sequence[ast.Block], of: set[str] | None, without: set[str] | None = None
) -> Iterator[CompletionCandidate]:
    """The states of the blocks with a parent in `of` (None: of all blocks)."""
    for block in blocks:
        if of is None or _parent_state(block) in of:
            docs = dict(block.state_docs)
            for state in block.all_states:
                if state.text not in (without or ()):
                    detail = docs.get(state.text, "") or f"in {block.name.text}"
                    yield CompletionCandidate(state.text, lsp.CompletionItemKind.EnumMember, detail)


def _undeclared(blocks: Sequence[ast.Block], parent: str) -> Iterator[CompletionCandidate]:
    """The undeclared states in the transitions of a block."""
    declared = {state.text for block in blocks for state in block.all_states}
    for block in blocks:
        if _parent_state(block) == parent:
            for edge in block.edges:
                for name in (edge.source, *edge.targets):
                    if name.text not in declared:
                        kind = lsp.CompletionItemKind.EnumMember
                        yield CompletionCandidate(name.text, kind, "used, not declared")

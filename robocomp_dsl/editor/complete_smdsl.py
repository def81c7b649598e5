"""Names that a state machine can use at a place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session
from robocomp_dsl.syntax import ast_smdsl as ast
from robocomp_dsl.syntax.ddsl_instances import UNITS
from robocomp_dsl.syntax.lexer import Token

_DECLARING = ("STATES", "INITIAL_STATE", "END_STATE")
_TRANSITIONS = ("TRANSITIONS", "OLD_TRANSITIONS")


def names(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """States, events, units of time: what the place asks for."""
    kinds = [token.kind for token in cursor.statement]
    trees = [one.tree for one in session.checks_to_complete(cursor.path)]
    files = [tree for tree in trees if isinstance(tree, ast.File)]
    blocks = [b for f in files for b in ((f.machine,) if f.machine else ()) + f.substates]
    if cursor.last == "ON":
        events = (edge.event for block in blocks for edge in block.edges)
        kind = lsp.CompletionItemKind.Event
        yield from (Offer(one.text, kind, "event") for one in events if one)
    elif cursor.last == "NUMBER" and "AFTER" in kinds:
        yield from words(*UNITS)
    elif kinds == ["COLON"]:
        inside = {block.name.text for block in blocks}
        yield from _states(blocks, None, without=inside)
    elif cursor.inside in _TRANSITIONS:
        yield from _ends(blocks, cursor)
    elif kinds[:1] and kinds[0] in _DECLARING and (len(kinds) == 1 or cursor.last == "COMMA"):
        yield from _undeclared(blocks, _block(cursor.blocks[-1:]))


def _ends(blocks: Sequence[ast.Block], cursor: Cursor) -> Iterator[Offer]:
    """Where a transition may begin, or where it may lead to."""
    here = _block(cursor.blocks[-2:-1])
    if not cursor.statement:
        yield from _states(blocks, {here})
    elif cursor.last in ("__ANON_0", "COMMA"):
        yield from _states(blocks, _around(blocks, here))


def _block(opened: Sequence[Sequence[Token]]) -> str:
    """The state that a block is inside of; an empty text for the machine."""
    tokens = opened[0] if opened else ()
    inside = len(tokens) > 1 and tokens[0].kind == "COLON"
    return tokens[1].text if inside else ""


def _home(block: ast.Block) -> str:
    return block.name.text if isinstance(block, ast.Substates) else ""


def _around(blocks: Sequence[ast.Block], name: str) -> set[str]:
    """The block called `name` and those around it."""
    homes = {state.text: _home(block) for block in blocks for state in block.all_states}
    found = {""}
    while name not in found:
        found.add(name)
        name = homes.get(name, "")
    return found


def _states(
    blocks: Sequence[ast.Block], of: set[str] | None, without: set[str] | None = None
) -> Iterator[Offer]:
    """The states of some blocks, or of all."""
    for block in blocks:
        if of is None or _home(block) in of:
            docs = dict(block.docs)
            for state in block.all_states:
                if state.text not in (without or ()):
                    said = docs.get(state.text, "") or f"in {block.name.text}"
                    yield Offer(state.text, lsp.CompletionItemKind.EnumMember, said)


def _undeclared(blocks: Sequence[ast.Block], here: str) -> Iterator[Offer]:
    """States that the transitions of a block speak of, and no block declares."""
    declared = {state.text for block in blocks for state in block.all_states}
    for block in blocks:
        if _home(block) == here:
            for edge in block.edges:
                for name in (edge.source, *edge.targets):
                    if name.text not in declared:
                        kind = lsp.CompletionItemKind.EnumMember
                        yield Offer(name.text, kind, "used, not declared")

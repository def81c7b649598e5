"""What becomes of a run when a token does not fit.

In: the machine of a parser, the token being the next of its stream. Out: a finding, and the machine
in a state in which parsing goes on: behind a small correction if there is one, else behind the
statement, which is dropped.
"""

from __future__ import annotations

from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.machine import Entry, Machine
from robocomp_dsl.syntax.repair import Repair, hopeless, stray_text
from robocomp_dsl.syntax.repair_choice import choose
from robocomp_dsl.syntax.situation import Situation, expectation, quote
from robocomp_dsl.syntax.stream import Garbage
from robocomp_dsl.syntax.tables import END

LOOK_AHEAD = 24
PATIENCE = 500
"""Errors in a row, each but a consequence of the one before, after which a file is given up."""


def recover(machine: Machine) -> None:
    """Report what is wrong with the next token and make parsing possible again."""
    try:
        _correct_or_drop(machine)
    except Garbage as garbage:
        at = garbage.last.start
        message = "nothing makes sense any more; the rest of the file is not read"
        machine.findings.add(codes.GARBAGE, at, garbage.last.end, message)
        machine.cut(at)


def _correct_or_drop(machine: Machine) -> None:
    _complete_statement(machine)
    stack, restarts = machine.stack, machine.tables.restarts
    base = max(i for i, entry in enumerate(stack) if entry[0] in restarts)
    begun = len(stack) > base + 1
    item = _since(machine, stack[base + 1][2]) if begun else []
    situation = _situation(machine)
    outside = machine.builder.has_block and not situation.opened and not situation.one_sign()
    if outside and (not begun or (item and item[0].kind == "ID")):
        _pass_over_stray(machine, situation, item, base)
        return
    made = choose(situation, item, base + 1)
    _tell(machine, situation, made or hopeless(situation, item))
    if made:
        _apply(machine, made)
    else:
        _drop(machine, situation, base)
    if machine.findings.full and not machine.findings.cut:
        machine.cut(situation.ahead[0].start)


def _complete_statement(machine: Machine) -> None:
    """Reduce what is complete whatever follows, so that it is not lost with what is not."""
    while True:
        following = set(machine.tables.actions[machine.stack[-1][0]].values())
        if len(following) != 1 or max(following) >= 0:
            return
        machine.reduce(-1 - following.pop(), machine.stack[-1][3])


def _since(machine: Machine, start: int) -> list[Token]:
    """The tokens taken since the one that begins at `start`, if they are still known.

    Not those of an item with a whole block in it: nobody means to begin it anew, and the tokens in
    front of a block's last item need not be remembered.
    """
    item = [token for token in machine.trail if token.start >= start]
    if any(token.kind == "RBRACE" for token in item):
        return []
    return item if item and item[0].start == start else []


def _situation(machine: Machine) -> Situation:
    return Situation(
        tables=machine.tables,
        source=machine.findings.source,
        states=[entry[0] for entry in machine.stack],
        before=machine.trail[-1] if machine.trail else Token("", "", 0, 0),
        ahead=machine.stream.look(LOOK_AHEAD),
        opened=_opened(machine.stack),
    )


def _opened(entries: list[Entry]) -> list[Token]:
    """The braces among the entries that no other entry closes."""
    opened: list[Token] = []
    for _, value, _, _ in entries:
        if isinstance(value, Token) and value.kind == "LBRACE":
            opened.append(value)
        elif isinstance(value, Token) and value.kind == "RBRACE":
            del opened[-1:]
    return opened


def _tell(machine: Machine, situation: Situation, made: Repair) -> None:
    """Report once for a place: what follows without a step forward is a consequence."""
    cut = situation.ahead[0].kind == END and machine.findings.cut
    if machine.told_behind == situation.before.end:
        machine.untold += 1
        if machine.untold > PATIENCE and situation.ahead[0].kind != END:
            raise Garbage(situation.ahead[0])
    else:
        machine.untold = 0
    if not machine.untold and not cut:
        expected = expectation(situation, machine.builder.ITEMS)
        made.tell(machine.findings, f"expected {expected}, found {quote(situation.ahead[0])}")
    machine.told_behind = -1 if made.put else situation.before.end


def _apply(machine: Machine, made: Repair) -> None:
    for _ in range(made.skip):
        machine.stream.take()
    if made.keep:
        for _ in _since(machine, machine.stack[made.keep][2]):
            machine.trail.pop()
        del machine.stack[made.keep :]
    machine.stream.put(made.put)


def _drop(machine: Machine, situation: Situation, base: int) -> None:
    """Give up the statement that began above entry `base` and pass over the rest of it."""
    token, inside = situation.ahead[0], len(_opened(machine.stack[base + 1 :]))
    if token.kind == END:
        kept, closing = situation.closing()
        del machine.stack[kept:]
        machine.stream.put(closing)
        return
    del machine.stack[base + 1 :]
    if token.kind != "RBRACE" or inside or not situation.opened:
        text = situation.source.text
        machine.trail.append(machine.stream.pass_over_statement(inside, _keywords(machine), text))


def _pass_over_stray(machine: Machine, situation: Situation, item: list[Token], base: int) -> None:
    """Report what stands behind the end of the block that the file is about."""
    del machine.stack[base + 1 :]
    first, last, harmless = (item or situation.ahead)[0], situation.before, True
    if situation.ahead[0].kind != END:
        last, harmless = machine.stream.pass_over_until(_keywords(machine))
        machine.trail.append(last)
    _tell(machine, situation, stray_text(first, last, harmless))


def _keywords(machine: Machine) -> frozenset[str]:
    """The keywords that may come next."""
    return machine.tables.words.intersection(machine.tables.actions[machine.stack[-1][0]])

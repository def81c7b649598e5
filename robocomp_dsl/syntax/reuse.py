"""What a parser need not read again after an edit: items of top-level blocks that did not change.

In: the text that was parsed last, with a mark behind every item of the file and of its blocks, and
the new text. Out: marks for the new text; the machine of its parser jumps from mark to mark where
nothing changed in between. The tree and the findings are those of a full parse, because a mark
holds all that the rest of a parse depends on beside the text: the states of the stack, the token
before, what recovery remembers. And a jump ends where nothing of the edit was seen yet, or where
everything from here to the end of the file is as it was.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, NamedTuple

from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.record import Record
from robocomp_dsl.source import Piece, Source
from robocomp_dsl.syntax.edited import Changed, Edited
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.machine import Machine
from robocomp_dsl.syntax.tables import END

DEEPEST = 6
"""Entries of the stack behind an item of a top-level block: the start, the items of the file, the
keyword, name and brace of the block, its items. Further inside, marks cost more than they save."""


class Standing(NamedTuple):
    """What a parse depends on beside the text that is still to come.

    The states of the stack, the token before by kind, text and length, the errors in a row that
    were not reported (None where the last one is past), and whether the main block was there.
    """

    states: tuple[int, ...]
    kind: str
    text: str
    length: int
    untold: int | None
    has_block: bool


class Mark(NamedTuple):
    """A place between two items, in front of the token [start, end).

    The item before is number `nth` (from 1) of `items`; `found` counts the findings so far. What
    was read since the mark before has its spans in `piece`, which moves when it is used again.
    """

    start: int
    end: int
    before: Token
    standing: Standing
    items: list[Any]
    nth: int
    found: int
    piece: Piece


class Memory(Record):
    """What a parse leaves for the next one: its text, its marks in order, its findings."""

    source: Source
    marks: list[Mark]
    found: tuple[Diagnostic, ...] = ()


class Reuse:
    """One parse of a text of which an earlier version is known, or at least a later one expected.

    `jumped` says whether anything of the earlier tree is used again.
    """

    def __init__(self, earlier: Memory | None, findings: Findings) -> None:
        self.jumped = False
        self._findings = findings
        self._earlier = earlier or Memory(findings.source, [])
        self._edited = Edited(self._earlier.source.text, findings.source.text)
        known = self._earlier.marks if self._edited.is_local else []
        self._numbers = {mark.start: number for number, mark in enumerate(known)}
        # Marks up to this one are so far before the edit that nothing of it was seen there.
        self._before = bisect_right([mark.end for mark in known], self._edited.seen_from) - 1
        self._marks: list[Mark] = []
        self._piece = self._new_piece()

    def memory(self) -> Memory:
        """What the next parse may use."""
        marks = [] if self._findings.crowded else self._marks
        return Memory(self._findings.source, marks, tuple(self._findings.report))

    def between_items(self, machine: Machine, token: Token) -> Token:
        """Leave a mark in front of `token`; go on behind the items that did not change.

        Returns the token to go on with.
        """
        if len(machine.stack) > DEEPEST or machine.stream.has_more or token.kind == END:
            return token
        here = self._mark(machine, token)
        self._marks.append(here)
        self._piece = self._new_piece()
        by = self._edited.origin(here.before.end, here.end)
        number = self._numbers.get(here.start - by) if by is not None else None
        if by is None or number is None:
            return token
        last = self._furthest(number, here, by)
        if last <= number:
            return token
        try:
            self._jump(machine, number, last, by)
        except Changed:
            return token
        return machine.stream.take()

    def _new_piece(self) -> Piece:
        self._findings.place = piece = Piece(self._findings.source)
        return piece

    def _mark(self, machine: Machine, token: Token) -> Mark:
        before = machine.trail[-1]
        told = machine.told_behind == before.end
        standing = Standing(
            tuple([entry[0] for entry in machine.stack]),
            before.kind,
            before.text,
            before.end - before.start,
            machine.untold if told else None,
            machine.builder.has_block,
        )
        items: list[Any] = machine.stack[-1][1]
        found = len(self._findings.report)
        return Mark(token.start, token.end, before, standing, items, len(items), found, self._piece)

    def _furthest(self, number: int, here: Mark, by: int) -> int:
        """The last mark of a block to which nothing changed since mark `number`, here in the text.

        It is not behind `number` where nothing can be skipped.
        """
        marks = self._earlier.marks
        old = marks[number]
        if old.standing != here.standing or old.before.end != here.before.end - by:
            return number
        last = len(marks) - 1 if old.before.end > self._edited.end else self._before
        while last > number and not _beside(marks[last], old):
            last -= 1
        return last

    def _jump(self, machine: Machine, number: int, last: int, by: int) -> None:
        """Put the items between two marks of the old text behind those of the new one."""
        old, here = self._earlier.marks[number], self._marks[-1]
        passed = self._earlier.marks[number + 1 : last + 1]
        found = self._earlier.found[old.found : passed[-1].found]
        self._findings.again([self._edited.moved(one, here.piece.source) for one in found])
        here.items.extend(old.items[old.nth : passed[-1].nth])
        for mark in passed:
            self._marks.append(_moved(mark, by, old, here))
            mark.piece.source, mark.piece.shift = here.piece.source, mark.piece.shift + by
        standing = passed[-1].standing
        machine.builder.has_block = standing.has_block
        machine.jump(self._marks[-1].before, untold=standing.untold)
        self.jumped = True


def _beside(one: Mark, other: Mark) -> bool:
    """Whether two marks are in one block."""
    return one.items is other.items and one.standing.states == other.standing.states


def _moved(mark: Mark, by: int, old: Mark, here: Mark) -> Mark:
    """A mark behind `old` as one behind `here`."""
    before = mark.before
    beside = mark.items is old.items
    return Mark(
        mark.start + by,
        mark.end + by,
        Token(before.kind, before.text, before.start + by, before.end + by),
        mark.standing,
        here.items if beside else mark.items,
        mark.nth + (here.nth - old.nth if beside else 0),
        mark.found + here.found - old.found,
        mark.piece,
    )

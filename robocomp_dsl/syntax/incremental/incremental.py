"""Incremental parsing: unchanged items of top-level blocks are reused after an edit.

In: the text that was parsed last, with a checkpoint after every item of the file and of its blocks,
and the new text. Out: checkpoints for the new text; the parser skips from checkpoint to checkpoint
where nothing changed in between. Tree and diagnostics equal those of a full parse, because a
checkpoint holds everything besides the text that the rest of the parse depends on: the states of
the stack, the previous token, the state of error recovery. Skipping ends before the edit, or at the
end of the file.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, NamedTuple

from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.record import Record
from robocomp_dsl.source import Source, TextRegion
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.incremental.text_delta import StaleReference, TextDelta

MAX_STACK_DEPTH = 6
"""Stack entries after an item of a top-level block: the start, the items of the file, the keyword,
name and brace of the block, its items. Deeper checkpoints cost more time than they save."""


class ParserSnapshot(NamedTuple):
    """Everything that the rest of a parse depends on besides the remaining text.

    The states of the stack; kind, text and length of the previous token; the number of follow-on
    errors (None if the last token was accepted); whether the top-level block was found.
    """

    states: tuple[int, ...]
    kind: str
    text: str
    length: int
    suppressed: int | None
    has_block: bool


class Checkpoint(NamedTuple):
    """A position between two items, before the token [start, end).

    The previous item is number `item_number` (from 1) of `items`; `diagnostic_count` counts the
    diagnostics so far. `region` owns the spans since the previous checkpoint and moves on reuse.
    """

    start: int
    end: int
    previous: Token
    snapshot: ParserSnapshot
    items: list[Any]
    item_number: int
    diagnostic_count: int
    region: TextRegion


class ParseCache(Record):
    """The result of a parse for the next one: text, checkpoints in order, diagnostics."""

    source: Source
    checkpoints: list[Checkpoint]
    diagnostics: tuple[Diagnostic, ...] = ()


class IncrementalParse:
    """One parse of a text that is edited; `reused`: parts of the earlier tree are in the result."""

    def __init__(self, earlier: ParseCache | None, findings: FileDiagnostics) -> None:
        self.reused = False
        self._findings = findings
        self._earlier = earlier or ParseCache(findings.source, [])
        self._delta = TextDelta(self._earlier.source.text, findings.source.text)
        known = self._earlier.checkpoints if self._delta.is_local else []
        self._numbers = {checkpoint.start: number for number, checkpoint in enumerate(known)}
        # The parser had not read any edited text at the checkpoints up to this one.
        self._before = (
            bisect_right([checkpoint.end for checkpoint in known], self._delta.lookahead_limit) - 1
        )
        self._checkpoints: list[Checkpoint] = []
        self._region = self._new_region()

    def new_cache(self) -> ParseCache:
        """The cache for the next parse."""
        self._close_checkpoints()
        checkpoints = [] if self._findings.limit_reached else self._checkpoints
        return ParseCache(self._findings.source, checkpoints, tuple(self._findings.report))

    def at_item(self, machine: ParserState, token: Token) -> Token:
        """Add a checkpoint before `token` and skip the unchanged items after it.

        Returns the next token to parse.
        """
        self._close_checkpoints()
        if (
            len(machine.stack) > MAX_STACK_DEPTH
            or machine.stream.has_lookahead
            or token.kind == END
        ):
            return token
        here = self._checkpoint(machine, token)
        self._checkpoints.append(here)
        self._region = self._new_region()
        displacement = self._delta.displacement(here.previous.end, here.end)
        number = self._numbers.get(here.start - displacement) if displacement is not None else None
        if displacement is None or number is None:
            return token
        last = self._last_reusable(number, here, displacement)
        if last <= number:
            return token
        try:
            self._reuse_items(machine, number, last, displacement)
        except StaleReference:
            return token
        return machine.stream.take()

    def _close_checkpoints(self) -> None:
        """Close the checkpoints between an error and the earlier text that it depends on.

        No later parse skips from one of them.
        """
        since, self._findings.depends_from = self._findings.depends_from, None
        if since is None:
            return
        for number, checkpoint in enumerate(self._checkpoints):
            if checkpoint.start >= since:
                snapshot = checkpoint.snapshot._replace(suppressed=-1)
                self._checkpoints[number] = checkpoint._replace(snapshot=snapshot)

    def _new_region(self) -> TextRegion:
        self._findings.region = piece = TextRegion(self._findings.source)
        return piece

    def _checkpoint(self, machine: ParserState, token: Token) -> Checkpoint:
        before = machine.recent_tokens[-1]
        reported = machine.last_reported_end == before.end
        snapshot = ParserSnapshot(
            tuple([entry[0] for entry in machine.stack]),
            before.kind,
            before.text,
            before.end - before.start,
            machine.suppressed if reported else None,
            machine.builder.has_block,
        )
        items: list[Any] = machine.stack[-1][1]
        found = len(self._findings.report)
        return Checkpoint(
            token.start, token.end, before, snapshot, items, len(items), found, self._region
        )

    def _last_reusable(self, number: int, here: Checkpoint, displacement: int) -> int:
        """The last checkpoint of a block such that nothing changed since checkpoint `number`.

        It is `number` itself if nothing can be skipped.
        """
        checkpoints = self._earlier.checkpoints
        old = checkpoints[number]
        if old.snapshot != here.snapshot or old.previous.end != here.previous.end - displacement:
            return number
        last = len(checkpoints) - 1 if old.previous.end > self._delta.end else self._before
        while last > number and not _in_same_block(checkpoints[last], old):
            last -= 1
        return last

    def _reuse_items(self, machine: ParserState, number: int, last: int, displacement: int) -> None:
        """Append the items between two old checkpoints to those of the new text."""
        old, here = self._earlier.checkpoints[number], self._checkpoints[-1]
        passed = self._earlier.checkpoints[number + 1 : last + 1]
        found = self._earlier.diagnostics[old.diagnostic_count : passed[-1].diagnostic_count]
        self._findings.replay(
            [self._delta.move_diagnostic(diagnostic, here.region.source) for diagnostic in found]
        )
        here.items.extend(old.items[old.item_number : passed[-1].item_number])
        for checkpoint in passed:
            self._checkpoints.append(_move_checkpoint(checkpoint, displacement, old, here))
            checkpoint.region.source, checkpoint.region.offset = (
                here.region.source,
                checkpoint.region.offset + displacement,
            )
        snapshot = passed[-1].snapshot
        machine.builder.has_block = snapshot.has_block
        machine.resume_after(self._checkpoints[-1].previous, suppressed=snapshot.suppressed)
        self.reused = True


def _in_same_block(first: Checkpoint, second: Checkpoint) -> bool:
    """Whether two checkpoints are in the same block."""
    return first.items is second.items and first.snapshot.states == second.snapshot.states


def _move_checkpoint(
    checkpoint: Checkpoint, displacement: int, old: Checkpoint, here: Checkpoint
) -> Checkpoint:
    """A checkpoint after `old`, moved to the same position after `here`."""
    before = checkpoint.previous
    beside = checkpoint.items is old.items
    return Checkpoint(
        checkpoint.start + displacement,
        checkpoint.end + displacement,
        Token(before.kind, before.text, before.start + displacement, before.end + displacement),
        checkpoint.snapshot,
        here.items if beside else checkpoint.items,
        checkpoint.item_number + (here.item_number - old.item_number if beside else 0),
        checkpoint.diagnostic_count + here.diagnostic_count - old.diagnostic_count,
        checkpoint.region,
    )

"""An earlier parse of a text that is edited: which of its items the new text has, too.

In: the cache of the earlier parse, and a checkpoint of the current one. Out: the items that follow
there, with their checkpoints and diagnostics, moved to their new places.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, NamedTuple

from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.incremental.checkpoint import Checkpoint, ParseCache
from robocomp_dsl.syntax.incremental.text_delta import StaleReference, TextDelta


class ReusablePart(NamedTuple):
    """Items of one block, and the checkpoints and diagnostics in and between them."""

    items: list[Any]
    checkpoints: list[Checkpoint]
    diagnostics: list[Diagnostic]


class EarlierParse:
    """What can be reused of the parse of an earlier text in that of the source of `findings`."""

    def __init__(self, cache: ParseCache, findings: FileDiagnostics) -> None:
        self._cache = cache
        self._findings = findings
        self._delta = TextDelta(cache.source.text, findings.source.text)
        known = cache.checkpoints if self._delta.is_local else []
        self._numbers = {checkpoint.start: number for number, checkpoint in enumerate(known)}
        # The parser had not read any edited text at the checkpoints up to this one.
        ends = [checkpoint.read_end for checkpoint in known]
        self._before = bisect_right(ends, self._delta.lookahead_limit) - 1

    def has_checkpoint(self, item_start: int, token: Token) -> bool:
        """Whether there was a checkpoint at `token`, and nothing changed since `item_start`."""
        displacement = self._delta.displacement(item_start, token.end)
        return displacement is not None and token.start - displacement in self._numbers

    def part_after(self, here: Checkpoint) -> ReusablePart | None:
        """The unchanged items after `here`, as many as possible; None if there are none."""
        displacement = self._delta.displacement(here.item_start, here.end)
        if displacement is None:
            return None
        number = self._numbers[here.start - displacement]
        old = self._cache.checkpoints[number]
        moved = (old.previous.end + displacement, old.item_start + displacement)
        if old.snapshot != here.snapshot or moved != (here.previous.end, here.item_start):
            return None
        last = self._last_of_part(number)
        passed = self._cache.checkpoints[number + 1 : last + 1]
        # A part of the tree has one place only.
        if not passed or any(c.region.source is self._findings.source for c in passed):
            return None
        try:
            diagnostics = self._moved_diagnostics(old, passed[-1])
        except StaleReference:
            return None
        return ReusablePart(
            old.items[old.item_number : passed[-1].item_number],
            [checkpoint.moved(displacement, old, here) for checkpoint in passed],
            diagnostics,
        )

    def _last_of_part(self, number: int) -> int:
        """The last checkpoint of a block such that nothing changed since checkpoint `number`.

        It is `number` itself if nothing can be skipped.
        """
        checkpoints = self._cache.checkpoints
        old = checkpoints[number]
        last = len(checkpoints) - 1 if old.item_start > self._delta.end else self._before
        # Behind the limit, diagnostics depend on the number of those before.
        most = old.diagnostic_count + self._findings.count_before_limit
        while last > number and not (
            checkpoints[last].diagnostic_count <= most and checkpoints[last].in_block_of(old)
        ):
            last -= 1
        return last

    def _moved_diagnostics(self, first: Checkpoint, last: Checkpoint) -> list[Diagnostic]:
        """The diagnostics between two checkpoints. Raises `StaleReference`."""
        source = self._findings.source
        found = self._cache.diagnostics[first.diagnostic_count : last.diagnostic_count]
        return [self._delta.move_diagnostic(diagnostic, source) for diagnostic in found]

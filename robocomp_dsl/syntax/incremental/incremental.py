"""Incremental parsing: unchanged items of blocks are reused after an edit.

In: the texts that were parsed last, with checkpoints between their items, and the new text. Out:
checkpoints for the new text; the parser skips from checkpoint to checkpoint where nothing changed
in between. Tree and diagnostics equal those of a full parse, because a checkpoint holds everything
besides the text that the rest of the parse depends on. Skipping ends before the edit, or at the end
of a block.

Some edits, such as a stray brace, change the meaning of everything behind them. When they are
undone, the items come from an earlier text: the last one and the last one without errors are kept.
"""

from __future__ import annotations

from robocomp_dsl.source import TextRegion
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.incremental.checkpoint import (
    Checkpoint,
    ParseCache,
    checkpoint_at,
    item_start,
)
from robocomp_dsl.syntax.incremental.earlier_parse import EarlierParse, ReusablePart

MAX_STACK_DEPTH = 20
"""Stack entries at an item of the innermost blocks: start, and four for each block and its items.
Deeper blocks are parsed as a whole."""
TOP_DEPTH = 6
"""Stack entries at an item of a top-level block, which always gets a checkpoint."""
MIN_DISTANCE = 300
"""Characters since the last checkpoint before an item of an inner block gets one: a checkpoint
costs as much as half of a short item."""


class IncrementalParse:
    """One parse of a text that is edited; `history` has the earlier parses, the last one first."""

    def __init__(self, history: tuple[ParseCache, ...], findings: FileDiagnostics) -> None:
        self._findings = findings
        self._history = history
        self._earlier = [EarlierParse(cache, findings) for cache in history]
        self._checkpoints: list[Checkpoint] = []
        self._last = 0
        self._region = self._new_region()

    def new_history(self) -> tuple[ParseCache, ...]:
        """The history for the next parse: this one, the last one, and one without errors."""
        self._close_checkpoints()
        this = ParseCache(
            self._findings.source,
            self._checkpoints,
            tuple(self._findings.report),
            not self._findings.errors,
        )
        complete = [cache for cache in self._history[1:] if cache.complete]
        return (this, *self._history[:1], *complete[:1])

    def at_item(self, machine: ParserState, token: Token) -> Token:
        """Add a checkpoint before `token` and skip the unchanged items after it.

        Returns the next token to parse.
        """
        self._close_checkpoints()
        if (
            len(machine.stack) > MAX_STACK_DEPTH
            or machine.stream.has_lookahead
            or token.kind == END
            or self._findings.limit_reached
        ):
            return token
        start = item_start(machine)
        known = [earlier for earlier in self._earlier if earlier.has_checkpoint(start, token)]
        is_top = len(machine.stack) <= TOP_DEPTH
        if not known and not is_top and token.start - self._last < MIN_DISTANCE:
            return token
        here = checkpoint_at(machine, token, self._findings, self._region)
        self._add([here])
        for earlier in known:
            part = earlier.part_after(here)
            if part:
                self._reuse(machine, part)
                return machine.stream.take()
        return token

    def _reuse(self, machine: ParserState, part: ReusablePart) -> None:
        """Append the items of `part` to the innermost list of items."""
        last = part.checkpoints[-1]
        self._findings.replay(part.diagnostics)
        for checkpoint in part.checkpoints:
            checkpoint.region.source = self._findings.source
            checkpoint.region.offset = checkpoint.region_offset
        last.items.extend(part.items)
        self._add(part.checkpoints)
        machine.builder.has_block = last.snapshot.has_block
        machine.stream.note_read(last.read_end)
        machine.resume_after(last.previous, suppressed=last.snapshot.suppressed)

    def _add(self, checkpoints: list[Checkpoint]) -> None:
        self._checkpoints += checkpoints
        self._last = checkpoints[-1].start
        self._region = self._new_region()

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

"""Checkpoints of a parse: the positions between items at which a later parse can take over.

In: the state of the parser at the start of an item. Out: a checkpoint, which holds everything
besides the text that the rest of the parse depends on.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.record import Record
from robocomp_dsl.source import Source, TextRegion
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState


class ParserSnapshot(NamedTuple):
    """Everything that the rest of a parse depends on besides the remaining text.

    The states of the stack; the indentation of the lines of the open braces, which recovery
    compares; kind, text and length of the previous token; the number of follow-on errors (None if
    the last token was accepted); whether the top-level block was found.
    """

    states: tuple[int, ...]
    indents: tuple[str, ...]
    kind: str
    text: str
    length: int
    suppressed: int | None
    has_block: bool


class Checkpoint(NamedTuple):
    """A position between two items, before the token [start, end).

    The previous item, which recovery may read again, is number `item_number` (from 1) of `items`
    and begins at `item_start`; `diagnostic_count` counts the
    diagnostics so far. `region` owns the spans since the previous checkpoint; it has moved by
    `region_offset` since its text was parsed. The parser has read the text up to `read_end`.
    """

    start: int
    end: int
    previous: Token
    snapshot: ParserSnapshot
    items: list[Any]
    item_number: int
    item_start: int
    diagnostic_count: int
    region: TextRegion
    region_offset: int
    read_end: int

    def in_block_of(self, other: Checkpoint) -> bool:
        """Whether both checkpoints are in the same block."""
        return self.items is other.items and self.snapshot.states == other.snapshot.states

    def moved(self, displacement: int, old: Checkpoint, here: Checkpoint) -> Checkpoint:
        """A copy that is as far behind `here` as this checkpoint is behind `old`."""
        before, beside = self.previous, self.items is old.items
        return Checkpoint(
            self.start + displacement,
            self.end + displacement,
            Token(before.kind, before.text, before.start + displacement, before.end + displacement),
            self.snapshot,
            here.items if beside else self.items,
            self.item_number + (here.item_number - old.item_number if beside else 0),
            self.item_start + displacement,
            self.diagnostic_count + here.diagnostic_count - old.diagnostic_count,
            self.region,
            self.region_offset + displacement,
            max(self.read_end + displacement, here.read_end),
        )


class ParseCache(Record):
    """The result of a parse for later ones: text, checkpoints in order, diagnostics.

    `complete`: the text had no syntax errors.
    """

    source: Source
    checkpoints: list[Checkpoint]
    diagnostics: tuple[Diagnostic, ...]
    complete: bool


def checkpoint_at(
    machine: ParserState, token: Token, findings: FileDiagnostics, region: TextRegion
) -> Checkpoint:
    """The checkpoint before `token`, which starts an item; `region` ends here."""
    before = machine.recent_tokens[-1]
    reported = machine.last_reported_end == before.end
    text = findings.source.text
    snapshot = ParserSnapshot(
        tuple([entry[0] for entry in machine.stack]),
        tuple(
            [
                _indentation(text, value.start)
                for _, value, _, _ in machine.stack
                if isinstance(value, Token) and value.kind == "LBRACE"
            ]
        ),
        before.kind,
        before.text,
        before.end - before.start,
        machine.suppressed if reported else None,
        machine.builder.has_block,
    )
    items: list[Any] = machine.stack[-1][1]
    return Checkpoint(
        token.start,
        token.end,
        before,
        snapshot,
        items,
        len(items),
        item_start(machine),
        len(findings.report),
        region,
        0,
        max(token.end, machine.stream.read_end),
    )


def item_start(machine: ParserState) -> int:
    """Where the previous item of the innermost list of items begins."""
    item = machine.stack[-1][1][-1]
    return item.span.start if isinstance(item, Node) else machine.recent_tokens[-1].end


def _indentation(text: str, offset: int) -> str:
    """The blanks at the start of the line at `offset`."""
    start = max(text.rfind("\n", 0, offset), text.rfind("\r", 0, offset)) + 1
    line = text[start:offset]
    return line[: len(line) - len(line.lstrip())]

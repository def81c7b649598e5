"""Names that fit into the devices of a component in a DDSL file.

In: a cursor in such a statement, and the files as they were understood last. Out: offers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.syntax import ast_ddsl as ast

KINDS: dict[str, tuple[str, ...]] = {
    "control_board": ("part",),
    "calibrator": ("speed", "timeout", "home", "park", "zero"),
    "cartesian": ("tip", "base"),
}
"""The kinds that simulators and twins host, and their parameters."""

PHASES = ("startup", "interrupt1", "interrupt2", "interrupt3", "shutdown")
VERBS = ("attach", "detach", "calibrate", "park", "abort")

_LEVEL = 4
"""Tokens of `on startup level 5`."""


def in_devices(cursor: Cursor) -> bool:
    """Whether the cursor stands in a device, an attachment or an action."""
    first = cursor.statement[0].kind if cursor.statement else ""
    action = first == "_ON" and cursor.inside == "COMPONENT"
    return first in ("DEVICE", "ATTACH") or action or cursor.inside == "DEVICE"


def names(cursor: Cursor, instances: Sequence[ast.Instance]) -> Iterator[Offer]:
    """What the place asks for; `instances` are all of the file, the newest last."""
    statement, last = cursor.statement, cursor.last
    first = statement[0].kind if statement else ""
    if cursor.inside == "DEVICE":
        kind = cursor.block[-1].text
        if first == "SET" and len(statement) == 1:
            yield from words(*KINDS.get(kind, ()))
    elif first == "DEVICE" and last == "COLON":
        yield from words(*KINDS)
    elif first == "ATTACH" and last in ("ATTACH", "TO", "COMMA"):
        yield from _devices(cursor, instances)
    elif first == "_ON" and last == "_ON":
        yield from words(*PHASES)
    elif first == "_ON" and len(statement) == _LEVEL:
        yield from words(*VERBS)
    elif first == "_ON" and (len(statement) == _LEVEL + 1 or last == "BY"):
        yield from _devices(cursor, instances)


def _devices(cursor: Cursor, instances: Sequence[ast.Instance]) -> Iterator[Offer]:
    name = next((token.text for token in cursor.block if token.kind == "ID"), "")
    found = {
        device.name.text: device.kind.text
        for instance in instances
        if instance.name.text == name
        for device in instance.devices
    }
    kind = lsp.CompletionItemKind.Variable
    yield from (Offer(device, kind, f": {of}") for device, of in found.items())

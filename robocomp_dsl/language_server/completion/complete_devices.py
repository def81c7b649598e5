"""Completion of the devices of a component in a DDSL file.

In: the context and the instances of the file. Out: candidates.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.syntax.ast import ddsl as ast

KINDS: dict[str, tuple[str, ...]] = {
    "control_board": ("part",),
    "calibrator": ("speed", "timeout", "home", "park", "zero"),
    "cartesian": ("tip", "base"),
}
"""The kinds of devices that simulators and hardware components host, and their parameters."""

PHASES = ("startup", "interrupt1", "interrupt2", "interrupt3", "shutdown")
VERBS = ("attach", "detach", "calibrate", "park", "abort")

_LEVEL = 4
"""Tokens of `on startup level 5`."""


def in_devices(context: CompletionContext) -> bool:
    """Whether the cursor is in a device, an attachment or an action."""
    first = context.statement[0].kind if context.statement else ""
    action = first == "_ON" and context.block_kind == "COMPONENT"
    return first in ("DEVICE", "ATTACH") or action or context.block_kind == "DEVICE"


def candidates(
    context: CompletionContext, instances: Sequence[ast.Instance]
) -> Iterator[CompletionCandidate]:
    """Device kinds, parameters, phases, verbs and devices; `instances` has the newest last."""
    statement, last = context.statement, context.previous_kind
    first = statement[0].kind if statement else ""
    if context.block_kind == "DEVICE":
        kind = context.block[-1].text
        if first == "SET" and len(statement) == 1:
            yield from value_candidates(*KINDS.get(kind, ()))
    elif first == "DEVICE" and last == "COLON":
        yield from value_candidates(*KINDS)
    elif first == "ATTACH" and last in ("ATTACH", "TO", "COMMA"):
        yield from _devices(context, instances)
    elif first == "_ON" and last == "_ON":
        yield from value_candidates(*PHASES)
    elif first == "_ON" and len(statement) == _LEVEL:
        yield from value_candidates(*VERBS)
    elif first == "_ON" and (len(statement) == _LEVEL + 1 or last == "BY"):
        yield from _devices(context, instances)


def _devices(
    context: CompletionContext, instances: Sequence[ast.Instance]
) -> Iterator[CompletionCandidate]:
    name = next((token.text for token in context.block if token.kind == "ID"), "")
    kinds = {
        device.name.text: device.kind.text
        for instance in instances
        if instance.name.text == name
        for device in instance.devices
    }
    kind = lsp.CompletionItemKind.Variable
    yield from (CompletionCandidate(device, kind, f": {of}") for device, of in kinds.items())

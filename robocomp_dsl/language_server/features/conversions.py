"""The unit conversions of a bridge, for inlay hints and hover.

In: the model. Out: the span of each converted value, and the conversion as text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.symbols.bridge_declarations import expressions_of
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_values import Converted
from robocomp_dsl.source import Span

_STATED = re.compile(r"\bto\s*\[[^\]]*\]\Z", re.IGNORECASE)


def conversion_hints(
    bridge: Bridge, positions: PositionCodec
) -> Iterator[tuple[int, lsp.InlayHint]]:
    """A hint behind each converted value, with its offset."""
    seen: set[int] = set()
    for value in expressions_of(bridge):
        span = value.span
        if isinstance(value, Converted) and span.end not in seen:
            seen.add(span.end)
            stated = _STATED.search(span.text)
            label = _arithmetic(value) if stated else f"to [{value.unit}]: {_arithmetic(value)}"
            tip = f"converts {_units(value)}"
            position = positions.position_at(span.source, span.end)
            yield span.end, lsp.InlayHint(position, label, tooltip=tip, padding_left=True)


def conversion_at(bridge: Bridge, offset: int) -> tuple[Span, str] | None:
    """The innermost converted value at `offset`, and its conversion as Markdown."""
    found = [
        value
        for value in expressions_of(bridge)
        if isinstance(value, Converted) and value.span.start <= offset <= value.span.end
    ]
    if not found:
        return None
    value = min(found, key=lambda item: item.span.end - item.span.start)
    return value.span, f"converts {_units(value)}: `{_arithmetic(value)}`"


def _units(value: Converted) -> str:
    return f"[{value.value.unit}] to [{value.unit}]"


def _arithmetic(value: Converted) -> str:
    offset = f" {'-' if value.offset < 0 else '+'} {abs(value.offset):.6g}" if value.offset else ""
    factor = f"× {value.factor:.6g}" if value.factor != 1 or not offset else ""
    return f"{factor}{offset}".strip()

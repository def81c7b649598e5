"""Writes a Bottle in text form. In: a Bottle. Out: one line of text, without its end."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.bottle.values import FALSE, TRUE, Bottle, Vocab, Vocab64

_BARE = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
_QUOTED_WORDS = frozenset({"true", "false", "null", "inf", "nan"})
_VOCAB = re.compile(r"[!#-'*+\--Z^-z|~]{1,8}")
_ESCAPES = str.maketrans({'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\0": "\\0"})


def write_text(bottle: Bottle) -> str:
    """The text of a Bottle; numbers lose their width, and dictionaries are written as lists."""
    return " ".join(write_value(item) for item in _items(bottle))


def _items(bottle: Bottle) -> list[Any]:
    return bottle.tolist() if isinstance(bottle, np.ndarray) else bottle


def write_value(value: Any) -> str:
    """The text of one value."""
    if isinstance(value, Vocab | Vocab64):
        text = _vocab(value)
    elif isinstance(value, str):
        text = _string(value)
    elif isinstance(value, bytes | bytearray | memoryview):
        text = "{" + " ".join(map(str, bytes(value))) + "}"
    elif isinstance(value, list | np.ndarray):
        text = f"({write_text(value)})"
    elif isinstance(value, bool):
        text = "true" if value else "false"
    else:
        text = repr(float(value)) if isinstance(value, float) else str(int(value))
    return text


def _vocab(value: Vocab | Vocab64) -> str:
    if value == FALSE:
        return "false"
    if value == TRUE:
        return "true"
    text = value.text
    # A number is read back as an int32; YARP could not read the characters back at all.
    return f"[{text}]" if _VOCAB.fullmatch(text) else str(int(value))


def _string(value: str) -> str:
    if _BARE.fullmatch(value) and value not in _QUOTED_WORDS:
        return value
    return f'"{value.translate(_ESCAPES)}"'

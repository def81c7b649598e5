"""Reads a Bottle in text form, as YARP does. In: text. Out: a Bottle, or `MalformedMessage`.

YARP accepts every text; surprising results, such as 0 for `-`, are those of YARP's own reader.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.runtime.codec.bottle.values import (
    FALSE,
    MAX_DEPTH,
    TRUE,
    Int64,
    vocab,
    vocab64,
)
from robocomp_dsl.runtime.errors import MalformedMessage

_SEPARATORS = frozenset(" \t\r\n,")
_INT = re.compile(r"[+-]?\d+")
_HEX = re.compile(r"[+-]?0[xX][0-9a-fA-F]{1,8}")
_FLOAT = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_BYTE = re.compile(r"[+-]?\d{1,18}")
_INT64_MAX = 2**63 - 1
_SATURATING_DIGITS = 25
_WORDS: dict[str, Any] = {
    "true": TRUE,
    "false": FALSE,
    "null": vocab("null"),
    "inf": float("inf"),
    "+inf": float("inf"),
    "-inf": float("-inf"),
    "nan": float("nan"),
    "-": 0,
    "+": 0,
}
_ESCAPES = {"n": "\n", "r": "\r", "0": "\0"}


def read_text(text: str, version: int = 3) -> list[Any]:
    """The Bottle that `text` is for YARP of this major version.

    Raises `MalformedMessage` for lists that are nested too deep.
    """
    return _list(text, version, 1)


class Continuation:
    """Tells whether a Bottle continues on the next line."""

    def __init__(self) -> None:
        self._quoted = False
        self._depth = 0

    def feed(self, line: str) -> bool:
        """Add a line; returns whether quotes or brackets are open, or a backslash ends it."""
        escaped = False
        for character in line:
            if escaped:
                escaped = False
            elif character == "\\":
                escaped = True
            elif character == '"':
                self._quoted = not self._quoted
            elif not self._quoted:
                self._depth += (character in "({") - (character in ")}")
        return self._quoted or escaped or self._depth > 0


def _list(text: str, version: int, depth: int) -> list[Any]:
    if depth > MAX_DEPTH:
        raise MalformedMessage(f"lists are nested more than {MAX_DEPTH} deep")
    return [_value(token, version, depth) for token in _tokens(text)]


def _tokens(text: str) -> list[str]:
    """The tokens of one level. A token whose quotes or brackets never end is dropped."""
    tokens: list[str] = []
    start = -1
    quoted = escaped = False
    depth = 0
    for at, character in enumerate(text):
        if escaped:
            escaped = False
            continue
        if start < 0:
            if character in _SEPARATORS:
                continue
            start = at
        if character == "\\":
            escaped = True
        elif character == '"':
            quoted = not quoted
        elif not quoted:
            depth += (character in "({") - (character in ")}")
            if depth <= 0 and character in _SEPARATORS:
                tokens.append(text[start:at])
                start, depth = -1, 0
    if start >= 0 and not quoted and depth <= 0:
        tokens.append(text[start:])
    return tokens


def _value(token: str, version: int, depth: int) -> Any:
    if token in _WORDS:
        return _WORDS[token]
    match token[0]:
        case '"':
            return _string(token)
        case "(":
            return _list(token[1 : token.rfind(")")], version, depth + 1)
        case "{":
            return _blob(token)
        case "[":
            name = token[1:-1]
            return vocab(name) if version < 4 or len(name) <= 4 else vocab64(name)
    return _number(token)


def _number(token: str) -> Any:
    """A number, or else the string that the token is."""
    if _INT.fullmatch(token) and token.isascii():
        # Python limits the digits of a conversion; YARP saturates.
        digits = token.lstrip("+-").lstrip("0") or "0"
        number = int(digits[:_SATURATING_DIGITS])
        return _int(-number if token.startswith("-") else number)
    if _HEX.fullmatch(token):
        return _int(int(token, 16))
    if _FLOAT.fullmatch(token) and token.isascii():
        return float(token)
    return _string(token)


def _int(number: int) -> int:
    if -(2**31) <= number < 2**31:
        return number
    return Int64(max(-_INT64_MAX - 1, min(_INT64_MAX, number)))


def _string(token: str) -> str:
    if token.startswith('"'):
        end = token.rfind('"')
        token = token[1:end] if end > 0 else token[1:]
    if "\\" not in token:
        return token
    return re.sub(r"\\(.)", lambda m: _ESCAPES.get(m[1], m[1]), token, flags=re.DOTALL)


def _blob(token: str) -> bytes:
    end = token.rfind("}")
    words = token[1 : end if end > 0 else len(token)].replace(",", " ").split()
    return bytes(int(word) % 256 if _BYTE.fullmatch(word) else 0 for word in words)

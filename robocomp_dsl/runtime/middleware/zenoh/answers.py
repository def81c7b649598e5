"""What a server answers when it has no result: the bytes of a failure, and back.

In: an exception. Out: `RC`, a letter for its kind and its text or fields; and the exception again.
"""

from __future__ import annotations

from robocomp_dsl.runtime.errors import (
    DeclaredError,
    EncodeError,
    InterfaceMismatch,
    MalformedMessage,
    RemoteError,
    Timeout,
)
from robocomp_dsl.runtime.interface import Operation
from robocomp_dsl.runtime.middleware.calling import describe

_DECLARED = b"RCD"
_TEXTS = {InterfaceMismatch: b"RCI", MalformedMessage: b"RCM", RemoteError: b"RCR"}


def failure_bytes(operation: Operation, error: Exception) -> bytes:
    """`error`, raised by or before a handler of `operation`, as an answer."""
    if isinstance(error, DeclaredError) and isinstance(error, operation.throws):
        try:
            return _DECLARED + operation.encode_error(error)
        except EncodeError as wrong:
            error = wrong
    kind = _TEXTS.get(type(error))
    if kind:
        return kind + str(error).encode()
    return _TEXTS[RemoteError] + describe(error).encode()


def failure(operation: Operation, server: str, data: bytes, timeout: float) -> Exception:
    """The exception that an answer stands for. Never raises."""
    if data.startswith(_DECLARED):
        try:
            return operation.decode_error(data[len(_DECLARED) :])
        except MalformedMessage as error:
            return error
    text = data[3:].decode(errors="replace")
    what = f"{server}.{operation.name}"
    if data == b"Timeout":
        return Timeout(f"{what} gave no answer within {timeout:g} s")
    if data.startswith(_TEXTS[InterfaceMismatch]):
        return InterfaceMismatch(text)
    if data.startswith(_TEXTS[MalformedMessage]):
        return MalformedMessage(f"{what} could not read the request: {text}")
    if not data.startswith(_TEXTS[RemoteError]):
        text = data.decode(errors="replace")
    return RemoteError(f"{what} failed: {text}")

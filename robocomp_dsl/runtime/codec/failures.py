"""Encodes failures as error replies, and decodes them.

In: an exception. Out: `RC`, a letter for its kind and its message or fields; and the exception
again.
"""

from __future__ import annotations

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.user_errors import describe_error, message_of
from robocomp_dsl.runtime.errors import (
    CallRejected,
    DeclaredError,
    EncodeError,
    InterfaceMismatch,
    MalformedMessage,
    RejectedByReceiver,
    RemoteError,
    Timeout,
)

_DECLARED = b"RCD"
_TEXTS = {
    InterfaceMismatch: b"RCI",
    MalformedMessage: b"RCM",
    RejectedByReceiver: b"RCJ",
    RemoteError: b"RCR",
}
_PLAIN = {b"RCI": InterfaceMismatch, b"RCJ": CallRejected}
"""Kinds whose message is complete."""


def encode_failure(operation: Operation, error: BaseException) -> bytes:
    """`error`, raised in or before a handler of `operation`, as bytes of an error reply."""
    if isinstance(error, DeclaredError) and isinstance(error, operation.throws):
        try:
            return _DECLARED + operation.encode_error(error)
        except EncodeError as wrong:
            error = wrong
    kind = _TEXTS.get(type(error))
    if kind:
        return kind + message_of(error).encode(errors="replace")
    return _TEXTS[RemoteError] + describe_error(error).encode(errors="replace")


def decode_failure(operation: Operation, server: str, data: bytes, timeout: float) -> Exception:
    """The exception of an error reply. Never raises."""
    if data.startswith(_DECLARED):
        try:
            return operation.decode_error(data[len(_DECLARED) :])
        except MalformedMessage as error:
            return error
    text = data[3:].decode(errors="replace")
    what = f"{server}.{operation.name}"
    if data == b"Timeout":
        return Timeout(f"{what} did not reply within {timeout:g} s")
    plain = _PLAIN.get(data[:3])
    if plain:
        return plain(text)
    if data.startswith(_TEXTS[MalformedMessage]):
        return MalformedMessage(f"{what} could not decode the request: {text}")
    if not data.startswith(_TEXTS[RemoteError]):
        text = data.decode(errors="replace")
    return RemoteError(f"{what} failed: {text}")

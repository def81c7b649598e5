"""Failures of a service as the text of an error reply, and back.

In: an exception. Out: bytes behind the byte 0 of a reply. Programs of ROS show the text; a service
that only components know has the error replies of `codec.failures`, with declared exceptions.
"""

from __future__ import annotations

from robocomp_dsl.runtime.codec import failures
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.user_errors import describe_error, message_of
from robocomp_dsl.runtime.errors import (
    CallRejected,
    InterfaceMismatch,
    MalformedMessage,
    RejectedByReceiver,
    RemoteError,
)

_KINDS: dict[type[BaseException], str] = {
    InterfaceMismatch: "InterfaceMismatch: ",
    MalformedMessage: "MalformedMessage: ",
    RejectedByReceiver: "CallRejected: ",
}


def encode_failure(operation: Operation, error: BaseException, *, is_ros: bool) -> bytes:
    """The error reply for an exception that was raised in or before the handler. Never raises."""
    if not is_ros:
        return failures.encode_failure(operation, error)
    kind = _KINDS.get(type(error))
    text = describe_error(error) if kind is None else kind + message_of(error)
    return text.encode(errors="replace")


def decode_failure(
    operation: Operation, what: str, data: bytes, timeout: float, *, is_ros: bool
) -> Exception:
    """The exception of an error reply; `what` is `server.operation`. Never raises."""
    if not is_ros:
        server = what.removesuffix(f".{operation.name}")
        return failures.decode_failure(operation, server, data, timeout)
    text = data.decode(errors="replace")
    for kind, prefix in _KINDS.items():
        if text.startswith(prefix):
            reason = text.removeprefix(prefix)
            if kind is MalformedMessage:
                return MalformedMessage(f"{what} could not decode the request: {reason}")
            return (CallRejected if kind is RejectedByReceiver else InterfaceMismatch)(reason)
    return RemoteError(f"{what} failed: {text}")

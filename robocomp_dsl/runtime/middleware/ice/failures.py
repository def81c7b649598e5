"""Failures of calls as exceptions of Ice, and back.

In: an exception of a handler, or an exception that Ice raised for a call. Out: the exception for
the other plane. Plain Ice programs see `UnknownException` with a readable text.
"""

from __future__ import annotations

from typing import Any

import Ice

from robocomp_dsl.runtime.component.user_errors import describe_error, message_of
from robocomp_dsl.runtime.errors import (
    InterfaceMismatch,
    MalformedMessage,
    NoServer,
    RemoteError,
    Timeout,
)
from robocomp_dsl.runtime.middleware.ice.communicator import reason
from robocomp_dsl.runtime.middleware.transport import ServerLost

_MALFORMED, _MISMATCH = "MalformedMessage: ", "InterfaceMismatch: "
DEFAULT_LIMIT = 1024 * 1024
"""`Ice.MessageSizeMax` of programs that do not set it, in bytes."""

_NO_CONNECTION = (
    Ice.ConnectFailedException,
    Ice.ConnectTimeoutException,
    Ice.DNSException,
    Ice.NoEndpointException,
    Ice.NotRegisteredException,
    Ice.FileException,
    Ice.ConnectionRefusedException,
)
_LOST = (
    Ice.ConnectionLostException,
    Ice.CloseConnectionException,
    Ice.ConnectionManuallyClosedException,
    Ice.ConnectionTimeoutException,
    Ice.CommunicatorDestroyedException,
    Ice.InvocationCanceledException,
    Ice.ObjectAdapterDeactivatedException,
    Ice.SocketException,
)
_HINTS = {
    "unexpected operation mode": "only one of the two sides declares it `idempotent`",
    "OperationNotExist": "it has no operation of this name",
    "Marshal": "the two sides disagree about parameters or types",
    "UnmarshalOutOfBounds": "the two sides disagree about parameters or types",
    "Encapsulation": "the two sides disagree about parameters or types",
}


def encode_failure(error: BaseException) -> Any:
    """The exception to raise in a servant for any failure but a declared exception."""
    if isinstance(error, Ice.Exception):
        return error
    if isinstance(error, MalformedMessage):
        return Ice.UnknownLocalException(f"{_MALFORMED}{message_of(error)}")
    if isinstance(error, InterfaceMismatch):
        return Ice.UnknownLocalException(f"{_MISMATCH}{message_of(error)}")
    return Ice.UnknownException(describe_error(error))


def decode_failure(
    error: Exception, what: str, peer: str, timeout: float, size: int, *, external: bool
) -> Exception:
    """The exception for a failed call of `what` with a request of `size` bytes.

    `peer` is the server with its address, for messages. An `external` server that cannot be
    reached is not known to be lost: it may not have been started yet.
    """
    if isinstance(error, Ice.InvocationTimeoutException):
        return Timeout(f"{what} did not reply within {timeout:g} s")
    if isinstance(error, _NO_CONNECTION):
        text = f"{peer} cannot be reached: {reason(error)}"
        return NoServer(f"{text}; start it, or correct its address") if external else _lost(text)
    if isinstance(error, Ice.ObjectNotExistException | Ice.FacetNotExistException):
        name = error.id.name
        text = f"{peer} is running, but has no object `{name}`; correct the name before the colon"
        return NoServer(text) if external else _lost(text)
    if isinstance(error, _LOST):
        return _connection_lost(error, what, peer, size)
    return _answered(error, what, peer)


def _lost(text: str) -> ServerLost:
    return ServerLost(text)


def _connection_lost(error: Exception, what: str, peer: str, size: int) -> Exception:
    if size > DEFAULT_LIMIT and isinstance(error, Ice.ConnectionLostException):
        return RemoteError(
            f"{what} failed: {peer} closed the connection while it received {size} bytes;"
            " plain Ice programs accept 1 MB: start it with --Ice.MessageSizeMax=0"
        )
    return _lost(f"{peer}: the connection was lost ({reason(error)})")


def _answered(error: Exception, what: str, peer: str) -> Exception:
    """The exception for an answer that is no result."""
    text = str(getattr(error, "unknown", "") or "")
    if isinstance(error, Ice.UnknownLocalException):
        if text.startswith(_MALFORMED):
            text = text.removeprefix(_MALFORMED)
            return MalformedMessage(f"{what} could not decode the request: {text}")
        if text.startswith(_MISMATCH):
            return InterfaceMismatch(text.removeprefix(_MISMATCH))
        if "MemoryLimit" in text:
            return RemoteError(
                f"{what} failed: its result is larger than the limit of {peer};"
                " start it with --Ice.MessageSizeMax=0"
            )
    for sign, hint in _HINTS.items():
        if sign in text or sign in type(error).__name__:
            return InterfaceMismatch(
                f"{peer} has another interface than {what} expects: {hint};"
                " compare its Slice file with `rcgen interface --to slice`"
            )
    if isinstance(error, Ice.UnknownUserException):
        return RemoteError(f"{what} failed: it raised {text}, which it does not declare")
    return RemoteError(f"{what} failed: {text.strip() or reason(error)}")

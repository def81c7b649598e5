"""Exceptions of communication and configuration, for user code to catch.

Exception
├── MiddlewareError            a call, a topic or a message failed
│   ├── NoServer               no component serves the interface
│   ├── AmbiguousServer        several components serve it, and no connection selects one
│   ├── Timeout                no reply arrived in time
│   ├── InterfaceMismatch      the peers were generated from different interfaces
│   ├── RemoteError            the server failed with an undeclared exception
│   └── MalformedMessage       the bytes do not match the interface (field and offset)
├── DeclaredError              base of the exceptions of an IDSL file
├── EncodeError                a value that does not fit its type (also a ValueError)
├── NotImplementedOperation    the component has no method for the operation (also a
│                              NotImplementedError)
├── ConfigError                an invalid configuration    } defined in
└── ParameterRejected          a rejected live change      } `runtime.parameters`
"""

from __future__ import annotations

from robocomp_dsl.runtime.data.struct import Struct


class MiddlewareError(Exception):
    """Base of all communication errors between two components."""


class NoServer(MiddlewareError):
    """No component serves the interface that is called."""


class AmbiguousServer(MiddlewareError):
    """Several components serve the interface, and the required port is connected to none of them.

    `servers` are their ports, as `component.Port`.
    """

    def __init__(self, message: str, servers: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.servers = servers


class Timeout(MiddlewareError):  # the usual name in middlewares
    """No reply arrived in time. Whether the operation was executed is unknown."""


class InterfaceMismatch(MiddlewareError):
    """The two components were generated from different versions of the interface."""


class RemoteError(MiddlewareError):
    """The server failed with an exception that its interface does not declare."""


class MalformedMessage(MiddlewareError):
    """Received bytes that are not a message of the expected type.

    `path` is the invalid field (`scan.points[3].x`; empty: the whole message),
    `offset` counts bytes from the start of the message, its 4-byte header included.
    """

    def __init__(self, reason: str, path: str = "", offset: int = 0) -> None:
        self.reason = reason
        self.path = path
        self.offset = offset
        super().__init__(reason, path, offset)

    def __str__(self) -> str:
        where = f"field {self.path}" if self.path else "message"
        return f"malformed message: {where}, byte {self.offset}: {self.reason}"


class EncodeError(ValueError):
    """A value that does not fit its type; nothing was sent. `path` is the assigned field."""

    def __init__(self, reason: str, path: str = "") -> None:
        self.reason = reason
        self.path = path
        super().__init__(reason, path)

    def __str__(self) -> str:
        return f"{self.path}: {self.reason}" if self.path else self.reason


class NotImplementedOperation(NotImplementedError):
    """The component declares the interface but has no method for the operation."""


class DeclaredError(Struct, Exception):
    """Base of the exceptions of an IDSL file; has fields like a struct."""

    __slots__ = ()
    _fields_ = ()

    def __str__(self) -> str:
        return repr(self)

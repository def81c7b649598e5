"""The exceptions of a running component that users catch.

Exception
├── MiddlewareError           a call, a topic or a message failed
│   ├── NoServer              no component serves the interface that is called
│   ├── AmbiguousServer       several serve it, and no wire selects one
│   ├── Timeout               no answer arrived in time
│   ├── InterfaceMismatch     the two sides were generated from different interfaces
│   ├── NotPublishable        an operation that returns something is called on a topic
│   ├── CallRejected          a monitor of the connection rejected the call
│   ├── RemoteError           the other side failed with an error that it does not declare
│   └── MalformedMessage      the bytes do not match the interface (offset and field)
├── DeclaredError             base of the exceptions that an IDSL file declares
├── EncodeError               a value that its type cannot carry (also a ValueError)
├── MonitorError              a monitor of the deployment cannot be loaded
├── NotImplementedOperation   the component has no method for it (also a NotImplementedError)
├── ConfigError               an invalid configuration         } defined in
└── ParameterRejected         a live change that was rejected  } `runtime.parameters`
"""

from __future__ import annotations

from robocomp_dsl.runtime.data.declared_error import DeclaredError
from robocomp_dsl.runtime.data.errors import EncodeError

__all__ = [
    "AmbiguousServer",
    "CallRejected",
    "DeclaredError",
    "EncodeError",
    "InterfaceMismatch",
    "MalformedMessage",
    "MiddlewareError",
    "MonitorError",
    "NoServer",
    "NotImplementedOperation",
    "NotPublishable",
    "RemoteError",
    "Timeout",
]


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


class NotPublishable(MiddlewareError):
    """An operation that returns something is called on a published port: nobody would reply."""


class SchemaError(MiddlewareError):
    """A component does not serve its schema, or what it sent is not a valid one."""


class CallRejected(MiddlewareError):
    """A monitor of the connection rejected the call, or another connection wins the input."""


class ReportedFailure(MiddlewareError):
    """A request failed; the log has been told why. The message for the caller has the place."""


class RejectedByReceiver(CallRejected):
    """A monitor of the served port rejected the call; the caller gets a `CallRejected`.

    A `CallRejected` of a call that a handler makes is a failure of that handler.
    """


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


class MonitorError(Exception):
    """A monitor that cannot be loaded, or does not fit to its connection; the component stops."""


class WindowError(Exception):
    """The window of a component cannot be created; the message has the file."""


class WorkerError(Exception):
    """The constructor of the user's class raised; `__cause__` is what it raised."""


class NotImplementedOperation(NotImplementedError):
    """The component declares the interface but has no method for this operation."""

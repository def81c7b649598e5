"""What can go wrong between components, as types. In: words. Out: exceptions that users catch.

Exception ├── MiddlewareError the call, the topic or the message did not work out │ ├── NoServer
nobody serves the interface that is called │ ├── AmbiguousServer several serve it and no wire says
which is meant │ ├── Timeout no answer came in time │ ├── InterfaceMismatch the two sides were
generated from different interfaces │ ├── RemoteError the other side failed with something it did
not declare │ └── MalformedMessage the bytes are not what the interface says (offset and field) ├──
DeclaredError base of the exceptions that an IDSL file declares ├── EncodeError a value that its
type cannot carry (also a ValueError) ├── NotImplementedOperation the component has no method for it
(also a NotImplementedError) ├── ConfigError a configuration that cannot be used } defined in └──
ParameterRejected a live parameter change that is not made } `runtime.parameters`
"""

from __future__ import annotations

from robocomp_dsl.runtime.data.struct import Struct


class MiddlewareError(Exception):
    """Base of everything that goes wrong between two components."""


class NoServer(MiddlewareError):
    """Nobody serves the interface that is called."""


class AmbiguousServer(MiddlewareError):
    """Several components serve the interface and the required port is not wired to one of them.

    `servers` are their ports, as `component.Port`.
    """

    def __init__(self, message: str, servers: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.servers = servers


class Timeout(MiddlewareError):  # the name that users of every middleware know
    """No answer came in time. Whether the operation was carried out is not known."""


class InterfaceMismatch(MiddlewareError):
    """The two sides were generated from interfaces of different shape."""


class SchemaError(MiddlewareError):
    """A component does not serve its schema, or what it sent is not a valid one."""


class RemoteError(MiddlewareError):
    """The other side failed in a way that its interface does not declare."""


class MalformedMessage(MiddlewareError):
    """Received bytes that are no message of the expected type.

    `path` is the field that could not be read (`scan.points[3].x`; empty: the message as a whole),
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
    """A value that its type cannot carry; nothing was sent. `path` is the field it was given to."""

    def __init__(self, reason: str, path: str = "") -> None:
        self.reason = reason
        self.path = path
        super().__init__(reason, path)

    def __str__(self) -> str:
        return f"{self.path}: {self.reason}" if self.path else self.reason


class NotImplementedOperation(NotImplementedError):
    """The component declares the interface but has no method for this operation."""


class DeclaredError(Struct, Exception):
    """Base of the exceptions that an IDSL file declares; carries fields as a struct does."""

    __slots__ = ()
    _fields_ = ()

    def __str__(self) -> str:
        return repr(self)

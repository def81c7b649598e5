"""The base class of generated proxies: typed methods over a channel of the middleware.

In: a channel. Out: an object with the operations of the interface as methods.
"""

from __future__ import annotations

from typing import ClassVar, TypeVar

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.ports import Channel
from robocomp_dsl.runtime.deprecated import DeprecatedProxyNames

R = TypeVar("R")


class Proxy(DeprecatedProxyNames):
    """A proxy of another component. Every call may raise a `MiddlewareError`.

    An operation with the name of a method of this class hides that method.
    """

    __slots__ = ("_calls", "_channel")
    INTERFACE: ClassVar[Interface]

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self._calls = {
            operation.name: channel.bind(operation) for operation in self.INTERFACE.operations
        }

    def _call(self, operation: str, /, *arguments: object) -> R:  # type: ignore[type-var]
        """Call an operation; the generated method declares the type of the result."""
        result: R = self._calls[operation](*arguments)
        return result

    def wait_for_server(self, timeout: float) -> bool:
        """Wait up to `timeout` s for a peer; returns whether there is one."""
        return self._channel.wait(timeout)

    def has_subscribers(self) -> bool:
        """Whether a publication would have a receiver now; cheaper than building a message."""
        return self._channel.has_subscribers()

    def set_timeout(self, seconds: float) -> None:
        """Set the time in s after which a call raises `Timeout`."""
        self._channel.timeout = seconds

"""Ice communicators and object adapters of one component.

In: properties. Out: a communicator for calls, and a serving communicator, with its adapters. There
are two, because destroying that of the calls is the way to end them.
"""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Mapping
from typing import Any

import Ice

from robocomp_dsl.runtime.errors import MiddlewareError

log = logging.getLogger("robocomp.ice")

_COMMON = {
    "Ice.MessageSizeMax": "0",  # Ice's default rejects messages above 1 MB
    "Ice.Warn.Connections": "0",
    "Ice.Warn.Dispatch": "0",  # failures of handlers are logged by the connection plane
}
_OUTGOING = {
    "Ice.RetryIntervals": "-1",  # a repeated call might be executed twice
    "Ice.Override.ConnectTimeout": "1000",
    # A plain server closes connections that are idle for a minute.
    "Ice.ACM.Client.Close": "0",
    "Ice.ACM.Client.Heartbeat": "3",
    "Ice.ACM.Client.Timeout": "30",
}
_INCOMING = {
    "Ice.ACM.Server.Heartbeat": "3",
    "Ice.ACM.Server.Close": "0",
}
_POOL_SIZE = 64
"""Calls that may wait for a free callback group or a remote reply at the same time."""
CLOSE_TIMEOUT_S = 1.0
"""Time for the end of running handlers when a communicator is destroyed."""


class IceLogger(Ice.Logger):  # type: ignore[misc]
    """Passes Ice's messages to the log of the component."""

    def print(self, message: str) -> None:
        """See `Ice.Logger`."""
        log.info("%s", message)

    def trace(self, category: str, message: str) -> None:
        """See `Ice.Logger`."""
        log.debug("%s: %s", category, message)

    def warning(self, message: str) -> None:
        """See `Ice.Logger`."""
        log.warning("%s", message)

    def error(self, message: str) -> None:
        """See `Ice.Logger`."""
        log.error("%s", message)

    def getPrefix(self) -> str:  # noqa: N802 - the name is Ice's
        """See `Ice.Logger`."""
        return ""

    def cloneWithPrefix(self, _prefix: str) -> IceLogger:  # noqa: N802 - the name is Ice's
        """See `Ice.Logger`."""
        return self


def open_outgoing(properties: Mapping[str, str]) -> Any:
    """A communicator for calls and publications; `properties` are the user's."""
    return _create({**_COMMON, **_OUTGOING, **properties})


def open_incoming(properties: Mapping[str, str]) -> Any:
    """A communicator that serves."""
    return _create({**_COMMON, **_INCOMING, **properties})


def _create(properties: Mapping[str, str]) -> Any:
    data = Ice.InitializationData()
    data.properties = Ice.createProperties()
    data.logger = IceLogger()
    for key, value in properties.items():
        data.properties.setProperty(key, value)
    try:
        return Ice.initialize(data)
    except Ice.Exception as error:
        raise MiddlewareError(f"Ice cannot start: {reason(error)}") from None


def create_adapter(communicator: Any, name: str, endpoints: str, *, ordered: bool) -> Any:
    """An active adapter; with `ordered` one thread dispatches, in the order of arrival.

    Raises `MiddlewareError` if it cannot listen at `endpoints`.
    """
    properties = communicator.getProperties()
    properties.setProperty(f"{name}.Endpoints", endpoints)
    properties.setProperty(f"{name}.ThreadPool.Size", "1")
    properties.setProperty(f"{name}.ThreadPool.SizeMax", "1" if ordered else str(_POOL_SIZE))
    try:
        adapter = communicator.createObjectAdapter(name)
        adapter.activate()
    except Ice.Exception as error:
        raise MiddlewareError(f"Ice cannot listen at `{endpoints}`: {reason(error)}") from None
    return adapter


def close(communicator: Any) -> None:
    """Destroy a communicator; do not wait for long for its handlers."""
    thread = threading.Thread(target=communicator.destroy, name="ice.destroy", daemon=True)
    thread.start()
    thread.join(CLOSE_TIMEOUT_S)


def reason(error: Exception) -> str:
    """What went wrong, from an exception of Ice."""
    if isinstance(error, Ice.DNSException):
        return f"the host `{error.host}` is unknown"
    number = getattr(error, "error", 0)
    if number > 0:
        return os.strerror(number)
    for attribute in ("reason", "str", "unknown"):
        text = getattr(error, attribute, "")
        if text:
            return str(text)
    return f"{type(error).__name__.removesuffix('Exception')}"

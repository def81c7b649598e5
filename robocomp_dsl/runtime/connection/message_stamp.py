"""Source time stamps of messages.

In: what a transport or a message itself states. Out: the stamp of the message that the calling
thread handles, and the stamp that it publishes with.

Transports without stamps, and messages without a header, cost nothing: a handler is wrapped only
for those that have one.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Literal, NamedTuple

from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.data.schema import Fields, StructBase

_HEADER_ID = "std_msgs/msg/Header"
_HEADER_FIELD = "header"
_MAX_SEC = 2**31 - 1


class MessageStamp(NamedTuple):
    """When a message was created.

    `time_ns` is in ns since the epoch of the sender's clock. `source`: "envelope" of a YARP port,
    "header" of a ROS message, or "arrival" if the message states no time. `sequence` is the number
    in the envelope, None for other sources.
    """

    time_ns: int
    source: Literal["envelope", "header", "arrival"]
    sequence: int | None = None

    @property
    def seconds(self) -> float:
        """The time in s."""
        return self.time_ns / 1e9


class _CurrentMessage(threading.local):
    """What the thread handles and publishes now."""

    received: MessageStamp | None = None
    message: Any = None
    published: MessageStamp | None = None


_current = _CurrentMessage()


def message_stamp() -> MessageStamp:
    """The time stamp of the message that the calling handler handles.

    It is that of the YARP envelope, else that of the `header` of a ROS message, else the time of
    arrival; if the middleware does not state the latter, the time of this call. A header whose
    stamp is 0 states none, as in ROS. Call it in the thread of the handler.
    """
    received = _current.received
    if received is not None and received.source == "envelope":
        return received
    if _current.message is not None and (stamp := header_stamp(_current.message)):
        return stamp
    return received or MessageStamp(time.time_ns(), "arrival")


class publishing_stamp:  # noqa: N801 - used like a function, as `contextlib.suppress`
    """`with publishing_stamp(time_ns): proxy.push(...)`: publish with a time stamp.

    A port on `yarp` writes it as the envelope of the message; `sequence` is counted by the port if
    it is None. Other middlewares have no stamps beside the message: set its `header`.
    """

    def __init__(self, time_ns: int, sequence: int | None = None) -> None:
        self._stamp = MessageStamp(int(time_ns), "envelope", sequence)
        self._former: MessageStamp | None = None

    def __enter__(self) -> MessageStamp:
        self._former, _current.published = _current.published, self._stamp
        return self._stamp

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        _current.published = self._former


def published_stamp(operation: Operation) -> Callable[[tuple[Any, ...]], MessageStamp | None]:
    """A function from the arguments of a publication to the stamp that it is published with.

    It is that of `publishing_stamp`, else that of the header of the message, else None.
    """
    index = header_input(operation.inputs)

    def stamp(arguments: tuple[Any, ...]) -> MessageStamp | None:
        if _current.published is not None or index is None or index >= len(arguments):
            return _current.published
        return header_stamp(arguments[index])

    return stamp


def handle_with_stamp(
    handle: Callable[[tuple[Any, ...]], Any], stamp: MessageStamp, arguments: tuple[Any, ...]
) -> Any:
    """Handle a message whose stamp the transport states."""
    former, _current.received = _current.received, stamp
    try:
        return handle(arguments)
    finally:
        _current.received = former


def with_header_stamp(operation: Operation, handler: Callable[..., Any]) -> Callable[..., Any]:
    """`handler`, during which `message_stamp` knows the header of the message.

    It is `handler` itself for a query, and for an operation without such a message.
    """
    index = header_input(operation.inputs)
    if index is None or operation.pattern is Pattern.QUERY or operation.outputs:
        return handler

    def handle_message(*arguments: Any) -> Any:
        former, _current.message = _current.message, arguments[index]
        try:
            return handler(*arguments)
        finally:
            _current.message = former

    return handle_message


def header_input(inputs: Fields) -> int | None:
    """The index of the first input that is a struct with a `header` of ROS."""
    for index, (_, type_) in enumerate(inputs):
        if isinstance(type_, type) and issubclass(type_, StructBase) and _has_header(type_):
            return index
    return None


def _has_header(struct: type[StructBase]) -> bool:
    return any(
        name == _HEADER_FIELD and getattr(type_, "_type_id_", "") == _HEADER_ID
        for name, type_ in struct._fields_
    )


def fill_header(message: Any, stamp: MessageStamp) -> None:
    """Set the stamp of a header that has none to that of the envelope of the message."""
    if stamp.source == "envelope" and stamp.time_ns >= 0 and header_stamp(message) is None:
        seconds, message.header.stamp.nanosec = divmod(stamp.time_ns, 1_000_000_000)
        message.header.stamp.sec = min(seconds, _MAX_SEC)


def header_stamp(message: Any) -> MessageStamp | None:
    """The stamp of the header of a message; None if it is 0, or not what it should be."""
    try:
        stamp = message.header.stamp
        time_ns = int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
    except (AttributeError, TypeError, ValueError, OverflowError):
        return None
    return MessageStamp(time_ns, "header") if time_ns else None

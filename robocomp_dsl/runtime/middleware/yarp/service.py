"""The serving side: messages of a port to the operations of an IDSL interface.

In: a served or subscribed port. Out: a `Receiver` for a port of YARP. Queries run in the thread of
their connection; commands and publications are queued, in order.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any, TypeAlias

from robocomp_dsl.runtime.codec.bottle import messages
from robocomp_dsl.runtime.codec.bottle.values import Bottle, Vocab, vocab
from robocomp_dsl.runtime.component.interface import Pattern
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.connection.message_stamp import handle_with_stamp
from robocomp_dsl.runtime.errors import EncodeError, InterfaceMismatch, MalformedMessage
from robocomp_dsl.runtime.middleware.yarp.envelopes import read_envelope

Handler: TypeAlias = "Callable[[Bottle, int, str], Bottle | None]"
"""From the items behind the name, and size and envelope of the message, to the reply."""


class OperationReceiver:
    """Passes messages to the operations of a port; `is_service`: queries are replied to."""

    def __init__(self, port: IncomingPort, *, is_service: bool) -> None:
        self._port = port
        self._is_service = is_service
        self._any = next(iter(port.operations.values()), None)
        needs_queue = not is_service or any(
            operation.pattern is Pattern.COMMAND for operation in port.interface.operations
        )
        self.queue = MessageQueue(port) if needs_queue else None
        self._plain = not is_service and messages.is_plain_topic(port.interface)
        self._handlers = {name: self._handler(served) for name, served in port.operations.items()}
        only = list(self._handlers.values())
        self._only = only[0] if len(only) == 1 and not is_service else None

    def _handler(self, served: IncomingOperation) -> Handler:
        if not self._is_service or served.operation.pattern is Pattern.COMMAND:
            assert self.queue is not None  # noqa: S101 - see `needs_queue`
            return _queued(served, self.queue, plain=self._plain)
        return _answered(served)

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        """See `port.Receiver`."""
        del wants_reply
        if self._plain and self._only:
            return self._only(bottle, size, envelope)
        first = bottle[0] if len(bottle) else ""
        name = first.text if isinstance(first, Vocab) else first
        handler = self._handlers.get(name) if isinstance(name, str) else None
        if handler:
            return handler(bottle[1:], size, envelope)
        if self._only:
            return self._only(bottle, size, envelope)  # a program that knows no names of operations
        if self._is_service and name == "help":
            return self._help()
        return self._unknown(name)

    def _unknown(self, name: Any) -> Bottle | None:
        """Reply, or report, that there is no such operation."""
        known = ", ".join(self._handlers)
        at = self._port.at
        text = f"{at.name} has no operation `{name!s:.40}`; it has {known}"
        if self._any is not None and not self._is_service:
            self._any.report(MalformedMessage(text))
            return None
        if self._any is None:
            return [messages.FAIL, text, "mismatch"]
        return messages.encode_failure(self._any.operation, InterfaceMismatch(text))

    def _help(self) -> list[Any]:
        lines = ["*** Available commands:"]
        for served in self._port.operations.values():
            names = [name for name, _ in served.operation.inputs]
            lines.append(" ".join([served.operation.name, *names]))
        return [vocab("many"), *lines]

    def reject(self, error: MalformedMessage) -> Bottle:
        """See `port.Receiver`."""
        if self._any is None:
            return []
        self._any.report(error)
        return messages.encode_failure(self._any.operation, error)

    def unwritable(self, error: EncodeError) -> Bottle:
        """See `port.Receiver`."""
        if self._any is None:
            return []
        self._any.report(error)
        return messages.encode_failure(self._any.operation, error)

    def close(self) -> None:
        """Pass no further message to a handler."""
        if self.queue:
            self.queue.close()


def _answered(served: IncomingOperation) -> Handler:
    operation, counts, handle = served.operation, served.counts, served.handle
    decode, encode = messages.request_decoder(operation), messages.reply_encoder(operation)

    def answer(items: Bottle, size: int, _envelope: str) -> Bottle:
        counts.bytes_in += size
        try:
            return encode(handle(decode(items)))
        except BaseException as error:
            served.report(error)
            return messages.encode_failure(operation, error)

    return answer


def _queued(served: IncomingOperation, queue: MessageQueue, *, plain: bool) -> Handler:
    operation, counts, handle, put = served.operation, served.counts, served.handle, queue.put
    decode = messages.plain_decoder(operation) if plain else messages.request_decoder(operation)

    def receive(items: Bottle, size: int, envelope: str) -> Bottle | None:
        stamp = read_envelope(envelope, time.time_ns())
        counts.bytes_in += size
        try:
            arguments = decode(items)
        except MalformedMessage as error:
            served.report(error)
            return messages.encode_failure(operation, error)
        put(served, partial(handle_with_stamp, handle, stamp), arguments)
        return None

    return receive

"""The serving side: messages of a port to the operations of an IDSL interface.

In: a served or subscribed port. Out: a `Receiver` for a port of YARP. Queries run in the thread of
their connection; commands and publications are queued, in order.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Container, Iterator
from functools import partial
from typing import Any, TypeAlias

from robocomp_dsl.runtime.codec.bottle import messages
from robocomp_dsl.runtime.codec.bottle.from_bottle import width_of
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.to_bottle import FAIL
from robocomp_dsl.runtime.codec.bottle.values import Bottle, Vocab, identical, vocab
from robocomp_dsl.runtime.component.interface import Pattern
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.connection.message_stamp import (
    fill_header,
    handle_with_stamp,
    header_input,
)
from robocomp_dsl.runtime.errors import EncodeError, InterfaceMismatch, MalformedMessage
from robocomp_dsl.runtime.middleware.yarp.envelopes import read_envelope

Handler: TypeAlias = "Callable[[Bottle, int, str], Bottle | None]"
"""From the items behind the name, and size and envelope of the message, to the reply."""


class OperationReceiver:
    """Passes messages to the operations of a port; `is_service`: queries are replied to."""

    def __init__(
        self, port: IncomingPort, layout: Layout = Layout.YARP, *, is_service: bool
    ) -> None:
        self._port = port
        self._layout = layout
        self._is_service = is_service
        self._any = next(iter(port.operations.values()), None)
        needs_queue = not is_service or any(
            operation.pattern is Pattern.COMMAND for operation in port.interface.operations
        )
        self.queue = MessageQueue(port) if needs_queue else None
        self._plain = not is_service and messages.is_plain_topic(port.interface)
        self._handlers = {name: self._handler(served) for name, served in port.operations.items()}
        self._widths = {
            name: sum(width_of(type_, layout) for _, type_ in served.operation.inputs)
            for name, served in port.operations.items()
        }
        self._words = {
            name: (
                messages.request_words(served.operation, layout),
                messages.thrift_words(name),
            )
            for name, served in port.operations.items()
        }
        only = list(self._handlers.values())
        self._only = only[0] if len(only) == 1 and not is_service else None

    def _handler(self, served: IncomingOperation) -> Handler:
        if not self._is_service or served.operation.pattern is Pattern.COMMAND:
            assert self.queue is not None  # noqa: S101 - see `needs_queue`
            return _queued(served, self.queue, self._layout, plain=self._plain)
        return _answered(served, self._layout)

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        """See `port.Receiver`."""
        del wants_reply
        if self._plain and self._only:
            return self._only(bottle, size, envelope)
        name, words = self._name(bottle)
        handler = self._handlers.get(name) if isinstance(name, str) else None
        if handler:
            return handler(bottle[words:], size, envelope)
        if self._only:
            return self._only(bottle, size, envelope)  # a program that knows no names of operations
        if self._is_service and name == "help":
            return self._help()
        return self._unknown(name)

    def _name(self, bottle: Bottle) -> tuple[Any, int]:
        """The name of the operation, and the number of its words."""
        first = _word(bottle[0]) if len(bottle) else ""
        if self._layout is not Layout.THRIFT:
            return first, 1
        # `set door` may be `set` with an argument, or `set_door`: what is written as a program
        # writes it counts more than the number of arguments, and that more than the length.
        best, best_rank = (first, 1), (False, False, 0)
        for name, count in _names(bottle, self._handlers):
            words = list(bottle[:count])
            exact = any(identical(words, known) for known in self._words[name])
            rank = (exact, len(bottle) - count == self._widths[name], count)
            if rank > best_rank:
                best, best_rank = (name, count), rank
        return best

    def _unknown(self, name: Any) -> Bottle | None:
        """Reply, or report, that there is no such operation."""
        known = ", ".join(self._handlers)
        at = self._port.at
        text = f"{at.name} has no operation `{name!s:.40}`; it has {known}"
        if self._any is not None and not self._is_service:
            self._any.report(MalformedMessage(text))
            return None
        if self._any is None:
            return [FAIL, text, "mismatch"]
        return messages.encode_failure(self._any.operation, InterfaceMismatch(text))

    def _help(self) -> list[Any]:
        lines = ["*** Available commands:"]
        for served in self._port.operations.values():
            names = [name for name, _ in served.operation.inputs]
            lines.append(" ".join([served.operation.name, *names]))
        if self._layout is Layout.THRIFT:
            return [vocab("many"), lines]
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


def _names(bottle: Bottle, known: Container[str]) -> Iterator[tuple[str, int]]:
    """The known names that the first words of a request are, and the number of words."""
    name = ""
    for count, item in enumerate(bottle, 1):
        word = _word(item)
        if not isinstance(word, str):
            return
        name = f"{name}_{word}" if count > 1 else word
        if name in known:
            yield name, count


def _word(item: Any) -> Any:
    return item.text if isinstance(item, Vocab) else item


def _answered(served: IncomingOperation, layout: Layout) -> Handler:
    operation, counts, handle = served.operation, served.counts, served.handle
    decode = messages.request_decoder(operation, layout)
    encode = messages.reply_encoder(operation, layout)

    def answer(items: Bottle, size: int, _envelope: str) -> Bottle:
        counts.bytes_in += size
        try:
            return encode(handle(decode(items)))
        except BaseException as error:
            served.report(error)
            return messages.encode_failure(operation, error)

    return answer


def _queued(
    served: IncomingOperation, queue: MessageQueue, layout: Layout, *, plain: bool
) -> Handler:
    operation, counts, handle, put = served.operation, served.counts, served.handle, queue.put
    decoder = messages.plain_decoder if plain else messages.request_decoder
    decode = decoder(operation, layout)
    reply = [messages.DONE] if layout is Layout.THRIFT else None
    with_header = header_input(operation.inputs)

    def receive(items: Bottle, size: int, envelope: str) -> Bottle | None:
        stamp = read_envelope(envelope, time.time_ns())
        counts.bytes_in += size
        try:
            arguments = decode(items)
        except MalformedMessage as error:
            served.report(error)
            return messages.encode_failure(operation, error)
        if with_header is not None:
            fill_header(arguments[with_header], stamp)
        put(served, partial(handle_with_stamp, handle, stamp), arguments)
        return reply

    return receive

"""The serving side over Ice: one servant for each served or subscribed port.

In: a served port. Out: a servant that passes decoded arguments to its operations. Queries run in
the threads of their adapter; commands and publications are queued by one thread, in order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import Ice

from robocomp_dsl.runtime.codec.ice import codec, wire
from robocomp_dsl.runtime.component.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.data.schema import BOOL, STRING, Sequence
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.middleware.ice.acknowledged_queue import AcknowledgedQueue
from robocomp_dsl.runtime.middleware.ice.failures import encode_failure
from robocomp_dsl.slice_identifiers import operation_names, valid_path

Answer: TypeAlias = "tuple[bool, bytes]"
Invoke: TypeAlias = Callable[[bytes, Any], Any]
"""From a request and Ice's `Current` to an answer, or a future answer."""

_DONE = (True, wire.EMPTY)
_IS_A = codec.request_decoder(Operation("ice_isA", inputs={"id": STRING}))
_BOOL = codec.reply_encoder(Operation("ice_isA", returns=BOOL))
_TEXT = codec.reply_encoder(Operation("ice_id", returns=STRING))
_TEXTS = codec.reply_encoder(Operation("ice_ids", returns=Sequence(STRING)))


class PortServant(Ice.Blobject):  # type: ignore[misc]
    """The servant of a port: its operations, and those of every Ice object."""

    def __init__(self, interface: Interface, operations: Mapping[str, Invoke]) -> None:
        self._id = f"::{valid_path(interface.name)}"
        self._ids = sorted(("::Ice::Object", self._id))
        self._operations: dict[str, Invoke] = {
            "ice_ping": lambda _data, _current: _DONE,
            "ice_id": lambda _data, _current: (True, _TEXT(self._id)),
            "ice_ids": lambda _data, _current: (True, _TEXTS(self._ids)),
            "ice_isA": self._is_a,
            **operations,
        }

    def ice_invoke(self, request: bytes, current: Any) -> Any:
        """See `Ice.Blobject`."""
        invoke = self._operations.get(current.operation)
        if invoke is None:
            raise Ice.OperationNotExistException(current.id, current.facet, current.operation)
        return invoke(request, current)

    def _is_a(self, request: bytes, _current: Any) -> Answer:
        try:
            (name,) = _IS_A(request)
        except MalformedMessage as error:
            raise encode_failure(error) from None
        return True, _BOOL(name in self._ids)


def service_servant(port: IncomingPort, queue: MessageQueue | None) -> PortServant:
    """The servant of a served port; `queue` is for its commands."""
    names = names_of(port.interface)
    module = port.interface.name.rpartition("::")[0]
    operations = {
        names[name]: _queued(served, queue)
        if queue and served.operation.pattern is Pattern.COMMAND
        else _answered(served, module)
        for name, served in port.operations.items()
    }
    return PortServant(port.interface, operations)


def topic_servant(port: IncomingPort, queue: MessageQueue | AcknowledgedQueue) -> PortServant:
    """The servant of a subscribed port."""
    names = names_of(port.interface)
    return PortServant(
        port.interface,
        {
            names[name]: _acknowledged(served, queue)
            if isinstance(queue, AcknowledgedQueue)
            else _queued(served, queue)
            for name, served in port.operations.items()
        },
    )


def names_of(interface: Interface) -> dict[str, str]:
    """The names of the operations on the wire, by those in the IDSL file."""
    short = interface.name.rpartition("::")[2]
    return operation_names(short, (operation.name for operation in interface.operations))


def _answered(served: IncomingOperation, module: str) -> Invoke:
    """Answers the requests of an operation."""
    operation, counts, handle = served.operation, served.counts, served.handle
    decode, encode = codec.request_decoder(operation), codec.reply_encoder(operation)
    throws = operation.throws
    encode_error = codec.error_encoder(throws, module)

    def answer(request: bytes, _current: Any) -> Answer:
        counts.bytes_in += len(request)
        try:
            reply = encode(handle(decode(request)))
        except BaseException as error:
            served.report(error)
            if not isinstance(error, throws):
                raise encode_failure(error) from None
            try:
                return False, encode_error(error)
            except EncodeError as wrong:
                raise encode_failure(wrong) from None
        counts.bytes_out += len(reply)
        return True, reply

    return answer


def _queued(served: IncomingOperation, queue: MessageQueue) -> Invoke:
    """Queues the messages of an operation."""
    counts, handle, put = served.counts, served.handle, queue.put
    decode = codec.request_decoder(served.operation)

    def receive(message: bytes, _current: Any) -> Answer:
        counts.bytes_in += len(message)
        try:
            put(served, handle, decode(message))
        except MalformedMessage as error:
            served.report(error)
            raise encode_failure(error) from None
        return _DONE

    return receive


def _acknowledged(served: IncomingOperation, queue: AcknowledgedQueue) -> Invoke:
    """Queues the messages of an operation; a full queue delays the answer."""
    counts, handle, put = served.counts, served.handle, queue.put
    decode = codec.request_decoder(served.operation)

    def receive(message: bytes, current: Any) -> Any:
        counts.bytes_in += len(message)
        try:
            arguments = decode(message)
        except MalformedMessage as error:
            served.report(error)
            raise encode_failure(error) from None
        return put(served, handle, arguments, len(message), is_answered=bool(current.requestId))

    return receive

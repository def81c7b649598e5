"""Messages of operations as Bottles.

A request or publication is the name of the operation, then the arguments; a reply is `[ok]`, then
the result and outputs; a failure is `[fail] "message" kind`, for a declared exception with its name
and fields behind. A topic with one operation that has one argument, a sequence of numbers, a struct
or a dictionary, needs no name: its message is the value itself, such as a Vector of YARP.

`Layout.THRIFT`, as code of `yarpidl_thrift`: the name is cut at each `_`, and pieces of up to four
characters are vocabs; a reply is the results without `[ok]`; a failure starts with `[fail]`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from robocomp_dsl.runtime.codec.bottle.from_bottle import as_items, items_to_fields, width_of
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.to_bottle import (
    FAIL,
    OK,
    fields_to_items,
    is_spliced,
    item_converter,
)
from robocomp_dsl.runtime.codec.bottle.values import Bottle, is_word, vocab
from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.component.user_errors import describe_error, message_of
from robocomp_dsl.runtime.data.schema import BOOL, BYTE, OCTET, Array, Dictionary, Fields
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import (
    CallRejected,
    DeclaredError,
    EncodeError,
    InterfaceMismatch,
    MalformedMessage,
    RejectedByReceiver,
    RemoteError,
)

DONE = vocab("done")
"""What a Thrift service replies to a oneway call if a reply is asked for."""
_VOCAB_LENGTH = 4
_KINDS: dict[type[BaseException], str] = {
    InterfaceMismatch: "mismatch",
    MalformedMessage: "malformed",
    RejectedByReceiver: "rejected",
}
_DECLARED, _REMOTE = "declared", "remote"
_ALL_KINDS = {*_KINDS.values(), _DECLARED, _REMOTE}
_VOID = ("ok", "done")
"""Replies of a Thrift service without a result; those of `yarpidl_thrift` are empty."""


def is_plain_topic(interface: Interface) -> bool:
    """Whether the messages of a topic are its only argument itself."""
    if len(interface.operations) != 1 or len(interface.operations[0].inputs) != 1:
        return False
    (_, type_), *_ = interface.operations[0].inputs
    if isinstance(type_, Array):
        return type_.element not in {BOOL, BYTE, OCTET}
    if isinstance(type_, Dictionary):
        return True
    return isinstance(type_, type) and issubclass(type_, Struct)


def request_words(operation: Operation, layout: Layout) -> list[Any]:
    """What a request starts with."""
    name = operation.name
    if layout is not Layout.THRIFT:
        return [name]
    words = thrift_words(name)
    if _starts_with_bool(operation.inputs):
        # `WireReader::readTag` of YARP takes a vocab behind a vocab for a part of the name.
        words[-1] = name.split("_")[-1]
    return words


def thrift_words(name: str) -> list[Any]:
    """The name of an operation as code of `yarpidl_thrift` writes it."""
    pieces = name.split("_")
    return [vocab(piece) if len(piece) <= _VOCAB_LENGTH else piece for piece in pieces]


def _starts_with_bool(fields: Fields) -> bool:
    for _, type_ in fields:
        if is_spliced(type_, Layout.THRIFT):
            return _starts_with_bool(cast("type[Struct]", type_)._fields_)
        return type_ is BOOL
    return False


def request_encoder(
    operation: Operation, layout: Layout = Layout.YARP
) -> Callable[[tuple[Any, ...]], list[Any]]:
    """A function from arguments to a request, or to a publication."""
    convert = fields_to_items(operation.inputs, layout)
    words = request_words(operation, layout)
    return lambda arguments: [*words, *convert(arguments)]


def plain_encoder(
    operation: Operation, layout: Layout = Layout.YARP
) -> Callable[[tuple[Any, ...]], Bottle]:
    """A function from the only argument to a publication of a plain topic."""
    convert = fields_to_items(operation.inputs, layout)
    if is_spliced(operation.inputs[0][1], layout):
        return convert
    return lambda arguments: convert(arguments)[0]


def request_decoder(
    operation: Operation, layout: Layout = Layout.YARP
) -> Callable[[Bottle], tuple[Any, ...]]:
    """A function from the items behind the name to arguments.

    A caller of a Thrift service may leave out the last arguments, if they have defaults.
    """
    convert = items_to_fields(operation.inputs, layout)
    if layout is not Layout.THRIFT or not operation.defaults:
        return lambda items: tuple(convert(items))
    shorter = {}
    for missing in range(1, len(operation.defaults) + 1):
        fields = operation.inputs[:-missing]
        width = sum(width_of(type_, layout) for _, type_ in fields)
        shorter[width] = items_to_fields(fields, layout), operation.defaults[-missing:]

    def decode(items: Bottle) -> tuple[Any, ...]:
        if len(items) not in shorter:
            return tuple(convert(items))
        first, defaults = shorter[len(items)]
        return (*first(items), *defaults)

    return decode


def plain_decoder(
    operation: Operation, layout: Layout = Layout.YARP
) -> Callable[[Bottle], tuple[Any, ...]]:
    """A function from a publication of a plain topic to its only argument."""
    convert = items_to_fields(operation.inputs, layout)
    if is_spliced(operation.inputs[0][1], layout):
        return lambda items: tuple(convert(items))
    return lambda items: tuple(convert([items]))


def reply_encoder(operation: Operation, layout: Layout = Layout.YARP) -> Callable[[Any], list[Any]]:
    """A function from the result of a handler to a reply."""
    outputs = operation.outputs
    convert = fields_to_items(outputs, layout)
    words = [] if layout is Layout.THRIFT else [OK]

    def encode(result: Any) -> list[Any]:
        if len(outputs) > 1:
            if not isinstance(result, tuple):
                raise EncodeError(f"returns a tuple of {len(outputs)}, not {result!r:.40}")
            return [*words, *convert(result)]
        if not outputs and result is not None:
            raise EncodeError(f"returns nothing, not {result!r:.40}")
        return [*words, *convert((result,) if outputs else ())]

    return encode


def reply_decoder(
    operation: Operation, layout: Layout = Layout.YARP, *, external: bool
) -> Callable[[Bottle], Any]:
    """A function from a reply that is no failure to the result of a proxy.

    An `external` server may omit `[ok]`; if the result is a bool, a lone `[ok]` is the result.
    """
    outputs = operation.outputs
    convert = items_to_fields(outputs, layout)
    is_flag = len(outputs) == 1 and outputs[0][1] is BOOL

    def result_of(items: Bottle) -> Any:
        values = convert(items)
        if len(values) > 1:
            return tuple(values)
        return values[0] if values else None

    def decode_thrift(reply: Bottle) -> Any:
        is_void = not outputs and len(reply) == 1 and any(is_word(reply[0], w) for w in _VOID)
        return result_of([] if is_void else reply)

    def decode(reply: Bottle) -> Any:
        items = as_items(reply) if len(outputs) != 1 else reply
        has_ok = len(items) > 0 and is_word(items[0], "ok")
        if not has_ok and not external:
            raise MalformedMessage("starts with neither [ok] nor [fail]")
        if has_ok and not (external and is_flag and len(items) == 1):
            items = items[1:]
        return result_of(items)

    return decode_thrift if layout is Layout.THRIFT else decode


def is_failure(
    reply: Bottle, operation: Operation, layout: Layout = Layout.YARP, *, external: bool
) -> bool:
    """Whether a reply reports a failure; of an `external` server, a lone `[fail]` may be false."""
    if not len(reply) or not is_word(reply[0], "fail"):
        return False
    outputs = operation.outputs
    is_flag = len(outputs) == 1 and outputs[0][1] is BOOL
    if layout is Layout.THRIFT:
        # A bool at the start of a result is `[fail]` if it is false.
        return not is_flag if len(reply) == 1 else _has_kind(reply)
    return not (external and is_flag and len(reply) == 1)


def _has_kind(reply: Bottle) -> bool:
    """Whether a reply is `[fail] "message" kind …`."""
    return len(reply) > 2 and isinstance(reply[1], str) and reply[2] in _ALL_KINDS


def encode_failure(operation: Operation, error: BaseException) -> list[Any]:
    """The reply for an exception that was raised in or before the handler. Never raises."""
    if isinstance(error, DeclaredError) and isinstance(error, operation.throws):
        name = type(error).__name__
        try:
            fields = item_converter(type(error))(error)
        except EncodeError as wrong:
            error = wrong
        else:
            return [FAIL, f"{name}: {error}", _DECLARED, name, fields]
    kind = _KINDS.get(type(error))
    if kind:
        return [FAIL, _text(message_of(error)), kind]
    return [FAIL, _text(describe_error(error)), _REMOTE]


def _text(text: str) -> str:
    return text.encode(errors="replace").decode()


def decode_failure(operation: Operation, what: str, reply: Bottle) -> Exception:
    """The exception of a reply that reports a failure. Never raises."""
    items = as_items(reply)
    text = str(items[1]) if len(items) > 1 else "it reported a failure without a reason"
    kind = items[2] if len(items) > 2 else ""
    if kind == _DECLARED and len(items) == 5:
        for throw in operation.throws:
            if throw.__name__ == items[3]:
                try:
                    values = items_to_fields(throw._fields_)(items[4])
                except (MalformedMessage, TypeError) as error:
                    return MalformedMessage(f"the exception of {what}: {error}")
                return throw(*values)
    if kind == "malformed":
        return MalformedMessage(f"{what} could not decode the request: {text}")
    if kind == "mismatch":
        return InterfaceMismatch(text)
    if kind == "rejected":
        return CallRejected(text)
    return RemoteError(f"{what} failed: {text}")

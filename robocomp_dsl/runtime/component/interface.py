"""Interfaces as the middleware uses them: operations, their patterns, and the type hash.

In: the declarations of generated code. Out: `Interface` and `Operation`, whose codecs are compiled
on first use.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from robocomp_dsl.runtime.codec.codec import (
    compile_decoder,
    compile_encoder,
    compile_error_decoder,
    compile_error_encoder,
)
from robocomp_dsl.runtime.data.schema import Declared, fields_of
from robocomp_dsl.runtime.data.type_hash import interface_hash, operation_shape
from robocomp_dsl.runtime.errors import DeclaredError

_UNIT = re.compile(r"\[[^\]]*\]")


class Pattern(enum.StrEnum):
    """The communication pattern of an operation.

    `COMMAND`: one way, one to one. `QUERY`: request and reply. `PUBLISH`: one way, one to many.
    `UNMARKED`: a publication on a topic, a query with an empty reply on a service.
    """

    COMMAND = "command"
    QUERY = "query"
    PUBLISH = "publish"
    UNMARKED = "unmarked"


class Operation:
    """One operation. `outputs`: the result under the name "", then the `out` parameters in order.

    Generated code states inputs and outputs as names with annotations, and the result as `returns`.
    The codecs use the values of the Python methods: a request is the tuple of the arguments; a
    reply is None without outputs, the output itself if there is one, else a tuple. Encoders raise
    only `EncodeError`, decoders only `MalformedMessage`. `defaults` are the values of the last
    inputs that a caller of a Thrift service may leave out; generated proxies always send them.
    `units` are those of parameters, by name.
    """

    def __init__(
        self,
        name: str,
        pattern: Pattern = Pattern.QUERY,
        inputs: Declared = (),
        outputs: Declared = (),
        throws: tuple[type[DeclaredError], ...] = (),
        *,
        returns: object = None,
        idempotent: bool = False,
        defaults: Mapping[str, object] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        self.name = name
        self.pattern = pattern
        self.inputs = fields_of(inputs)
        result = () if returns is None else fields_of((("", returns),))
        self.outputs = (*result, *fields_of(outputs))
        self.throws = throws
        self.idempotent = idempotent
        self.defaults = tuple((defaults or {}).values())
        self.units = units or {}

    @property
    def shape(self) -> str:
        """The canonical text that the type hash covers; peers with the same text understand it."""
        return operation_shape(
            self.pattern.value, self.name, self.inputs, self.outputs, self.throws, self.units
        )

    @cached_property
    def encode_request(self) -> Callable[[tuple[Any, ...]], bytes]:
        """Arguments to bytes."""
        return compile_encoder(self.inputs)

    @cached_property
    def decode_request(self) -> Callable[[bytes], tuple[Any, ...]]:
        """Bytes to arguments."""
        return compile_decoder(self.inputs)

    @cached_property
    def encode_reply(self) -> Callable[[Any], bytes]:
        """The result of a servant to bytes."""
        return compile_encoder(self.outputs, result=True)

    @cached_property
    def decode_reply(self) -> Callable[[bytes], Any]:
        """Bytes to the result of a proxy."""
        return compile_decoder(self.outputs, result=True)

    @cached_property
    def encode_error(self) -> Callable[[DeclaredError], bytes]:
        """A declared exception to bytes: its index in `throws`, then its fields.

        Raises `EncodeError` for an exception that the operation does not declare.
        """
        return compile_error_encoder(self.throws)

    @cached_property
    def decode_error(self) -> Callable[[bytes], DeclaredError]:
        """Bytes to the declared exception, which the caller raises."""
        return compile_error_decoder(self.throws)


class Interface:
    """One interface, `name` as in `Module::Interface`.

    `style` is "thrift" if it was imported from a Thrift service, else "". The middleware `yarp`
    carries calls of that style as the code of yarpidl_thrift does; others do not distinguish.
    """

    def __init__(self, name: str, *operations: Operation, style: str = "") -> None:
        self.name = name
        self.operations = operations
        self.style = style

    @cached_property
    def hash(self) -> bytes:
        """8 bytes that are equal for interfaces with the same canonical form.

        The canonical form has the names of the interface, its operations, parameters, fields and
        enumerators, their wire types and units, and the patterns. Type names are excluded: a
        component that uses two modules with types of the same name renames them.
        """
        return interface_hash(self.name, (operation.shape for operation in self.operations))

    @property
    def published(self) -> tuple[Operation, ...]:
        """The operations of a topic: those without a reply."""
        return tuple(o for o in self.operations if o.pattern is not Pattern.QUERY)

    @cached_property
    def shapes(self) -> dict[str, str]:
        """The shape of each operation by name, in the order of `operations`."""
        return {operation.name: operation.shape for operation in self.operations}

    @cached_property
    def hash_without_units(self) -> bytes:
        """The hash in components of earlier versions of this project, which did not cover units."""
        return interface_hash(self.name, (_UNIT.sub("", o.shape) for o in self.operations))

    @cached_property
    def _by_name(self) -> dict[str, Operation]:
        return {operation.name: operation for operation in self.operations}

    def operation(self, name: str) -> Operation:
        """The operation called `name`. Raises `KeyError`."""
        return self._by_name[name]

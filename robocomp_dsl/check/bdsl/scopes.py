"""The names that an expression can use, depending on where it is.

In: a name, or a name and a member of it. Out: a typed expression, or a finding.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import NoReturn, Protocol, TypeVar

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.items import joined_item_type, length_of
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.codes import bridge_values as value_codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.model.bridge_ports import TIME, BridgeInput
from robocomp_dsl.model.bridge_values import (
    BridgeCall,
    BridgeHub,
    Counter,
    Expression,
    HubValue,
    InputValue,
    ListExpression,
    Now,
    ReplyValue,
    RequestValue,
)
from robocomp_dsl.model.interface import Operation, Param
from robocomp_dsl.model.types import LONG, Struct
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Name

ParamValue = Callable[[Span, Param], Expression]
Item = TypeVar("Item")


class NamedMember(Protocol):
    """A field, a parameter or an enumerator of the model."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def span(self) -> Span:
        """Where its name is declared."""


class BridgeScope:
    """The names of outputs and hubs: inputs, hubs, and for outputs `now` and `counter`."""

    def __init__(
        self,
        context: BridgeContext,
        find_hub: Callable[[Name], BridgeHub | None],
        *,
        has_time: bool,
    ) -> None:
        self.context = context
        self._find_hub = find_hub
        self._has_time = has_time

    def names(self) -> list[str]:
        """All names, for suggestions."""
        times = ["now", "counter"] if self._has_time else []
        return [*self.context.inputs, *self.context.hubs, *times]

    def value(self, name: Name) -> Expression:
        """What `name` stands for. Raises `FaultyExpression`."""
        word, span = name.text, name.span
        self.context.used_names.add(word)
        if word in self.context.inputs:
            return input_value(span, _declared(self.context.inputs[word]))
        if word in self.context.hubs:
            hub = _declared(self._find_hub(name))
            length = hub.type.count if hub.length is None else hub.length
            return HubValue(span, hub.type, hub.type.unit, length, hub)
        if word not in self.names():
            self._reject(name)
        return _now_or_counter(word, span)

    def _reject(self, name: Name) -> NoReturn:
        if name.text in ("now", "counter"):
            message = f"`{name.text}` is available in outputs, not in hubs"
            self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message)
        reject_name(name, self.names(), self.context)

    def member(self, name: Name, member: Name) -> Expression | None:
        """The parameter `member` of `name`; None if it can only be a field of its value."""
        source = self.context.inputs.get(name.text)
        if source is None:
            return None
        self.context.used_names.add(name.text)
        return input_member(member, source, self.context)

    def input(self, name: Name) -> BridgeInput:
        """The input called `name`, for its time stamp. Raises `FaultyExpression`."""
        self.context.used_names.add(name.text)
        if name.text not in self.context.inputs:
            reject_name(name, list(self.context.inputs), self.context)
        return _declared(self.context.inputs[name.text])


class ServiceScope:
    """The names of a service: `request`, `now`, and the calls before."""

    def __init__(
        self,
        context: BridgeContext,
        request: tuple[Param, ...],
        calls: Mapping[str, BridgeCall | None],
        every_call: Collection[str] = (),
    ) -> None:
        """`calls` are the earlier calls, `every_call` the names of all calls of the service."""
        self.context = context
        self._request = request
        self._calls = calls
        self._every_call = every_call

    def names(self) -> list[str]:
        """All names, for suggestions."""
        return ["request", "now", *self._calls]

    def value(self, name: Name) -> Expression:
        """What `name` stands for. Raises `FaultyExpression`."""
        word, span = name.text, name.span
        if word not in self.names():
            self._reject(name)
        if word in self._calls:
            call = _declared(self._calls[word])
            return _whole(span, reply_parameters(call.port.operation), _reply_value(call))
        if word == "request":
            return _whole(span, self._request, _request_value)
        return _now_or_counter(word, span)

    def _reject(self, name: Name) -> NoReturn:
        word = name.text
        if word in self.context.inputs or word in self.context.hubs:
            self.context.used_names.add(word)
            help_ = f"a service uses {join_names(self.names())}; outputs use inputs and hubs"
            message = f"`{word}` is not available in a service"
            self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message, help_)
        if word in self._every_call:
            message = f"`{word}` is called later: calls are made in the order of writing"
            self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message)
        reject_name(name, self.names(), self.context)

    def member(self, name: Name, member: Name) -> Expression | None:
        """The parameter `member` of `name`; None if it can only be a field of its value."""
        if name.text == "request":
            return _member(member, self._request, _request_value, self.context)
        call = self._calls.get(name.text)
        if call is None:
            return None
        return _member(
            member, reply_parameters(call.port.operation), _reply_value(call), self.context
        )

    def input(self, name: Name) -> BridgeInput:
        """No input: a service has none. Raises `FaultyExpression`."""
        message = "`stamp` is not available in a service: it answers a request"
        self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message)


class Scope(Protocol):
    """The names of one place."""

    context: BridgeContext

    def names(self) -> list[str]:
        """All names, for suggestions."""

    def value(self, name: Name) -> Expression:
        """What `name` stands for. Raises `FaultyExpression`."""

    def member(self, name: Name, member: Name) -> Expression | None:
        """The parameter `member` of `name`; None if it can only be a field of its value."""

    def input(self, name: Name) -> BridgeInput:
        """The input called `name`, for its time stamp. Raises `FaultyExpression`."""


def reply_parameters(operation: Operation) -> tuple[Param, ...]:
    """The result of an operation, if it has one, and its `out` parameters."""
    result = operation.result
    first = (Param("result", result, operation.span),) if result is not None else ()
    return (*first, *operation.outputs)


def reject_name(name: Name, known: list[str], context: BridgeContext, noun: str = "") -> NoReturn:
    """Report an unknown name; `noun` is what it should be. Raises `FaultyExpression`."""
    report_unknown_name(
        context.report,
        codes.UNKNOWN_BRIDGE_NAME,
        name,
        f"the bridge declares no {noun}`{name.text}`",
        known,
        f"known here: {join_names(known) or 'nothing'}",
        declared=[context.declared[text] for text in known if text in context.declared],
    )
    raise FaultyExpression


def reject_field(
    name: Name, owner: str, members: Sequence[NamedMember], context: BridgeContext
) -> NoReturn:
    """Report an unknown field or parameter of `owner`. Raises `FaultyExpression`."""
    known = [member.name for member in members]
    report_unknown_name(
        context.report,
        value_codes.UNKNOWN_BRIDGE_FIELD,
        name,
        f"{owner} has no `{name.text}`",
        known,
        f"it has {join_names(known) or 'none'}",
        declared=[member.span for member in members if member.span.text == member.name],
    )
    raise FaultyExpression


def _declared(item: Item | None) -> Item:
    """A declaration; one that is faulty raises `FaultyExpression`, as it was reported."""
    if item is None:
        raise FaultyExpression
    return item


def _whole(span: Span, params: tuple[Param, ...], value: ParamValue) -> Expression:
    """The only parameter, or a list of all."""
    values = tuple(value(span, param) for param in params)
    if len(values) == 1:
        return values[0]
    return ListExpression(span, joined_item_type(values), "", len(values), values)


def _member(
    member: Name, params: tuple[Param, ...], value: ParamValue, context: BridgeContext
) -> Expression | None:
    if len(params) == 1 and isinstance(params[0].type, Struct):
        fields = [field.name for field in params[0].type.fields]
        if member.text in fields or member.text != params[0].name:
            return None
    for param in params:
        if param.name == member.text:
            return value(member.span, param)
    reject_field(member, "the operation", params, context)


def _now_or_counter(word: str, span: Span) -> Expression:
    return Now(span, TIME, "", None) if word == "now" else Counter(span, LONG, "", None)


def input_value(span: Span, source: BridgeInput) -> Expression:
    """The newest message of an input."""
    return _whole(span, source.parameters, _input_value(source))


def input_member(member: Name, source: BridgeInput, context: BridgeContext) -> Expression | None:
    """The parameter `member` of the newest message of an input."""
    return _member(member, source.parameters, _input_value(source), context)


def _input_value(source: BridgeInput) -> ParamValue:
    def value(span: Span, param: Param) -> Expression:
        return InputValue(span, param.type, param.unit, length_of(param.type), source, param)

    return value


def _request_value(span: Span, param: Param) -> Expression:
    return RequestValue(span, param.type, param.unit, length_of(param.type), param)


def _reply_value(call: BridgeCall) -> ParamValue:
    def value(span: Span, param: Param) -> Expression:
        return ReplyValue(span, param.type, param.unit, length_of(param.type), call, param)

    return value

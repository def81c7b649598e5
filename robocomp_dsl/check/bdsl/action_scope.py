"""The names that expressions of an action can use: `goal`, `now`, and its states."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NoReturn

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.scopes import input_member, input_value, reject_name
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.model.bridge_ports import TIME, BridgeInput
from robocomp_dsl.model.bridge_values import Expression, Now, RequestValue
from robocomp_dsl.model.interface import Param
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Name


class ActionScope:
    """The names of an action; `states` is empty for its commands, `later` are those states."""

    def __init__(
        self,
        context: BridgeContext,
        goal: Param,
        states: Mapping[str, BridgeInput | None],
        later: Collection[str] = (),
    ) -> None:
        self.context = context
        self._goal = goal
        self._states = states
        self._later = later

    def names(self) -> list[str]:
        """All names, for suggestions."""
        return ["goal", "now", *self._states]

    def value(self, name: Name) -> Expression:
        """What `name` stands for. Raises `FaultyExpression`."""
        if name.text in self._states:
            state = self._states[name.text]
            if state is None:
                raise FaultyExpression
            return input_value(name.span, state)
        if name.text == "goal":
            return self._goal_value(name.span)
        if name.text != "now":
            self._reject(name)
        return Now(name.span, TIME, "", None)

    def _goal_value(self, span: Span) -> Expression:
        return RequestValue(span, self._goal.type, "", None, self._goal)

    def _reject(self, name: Name) -> NoReturn:
        word = name.text
        if word in self._later:
            message = f"`{word}` is not available in a command, which is sent before it arrives"
            help_ = "a command uses `goal` and `now`"
            self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message, help_)
        if word in self.context.inputs or word in self.context.hubs:
            self.context.used_names.add(word)
            message = f"`{word}` is not available in an action"
            help_ = f"an action uses {join_names(self.names())}; receive it as a `state`"
            self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message, help_)
        reject_name(name, self.names(), self.context)

    def member(self, name: Name, member: Name) -> Expression | None:
        """The parameter `member` of `name`; None if it can only be a field of its value."""
        state = self._states.get(name.text)
        return input_member(member, state, self.context) if state else None

    def input(self, name: Name) -> BridgeInput:
        """No input: time stamps are not available. Raises `FaultyExpression`."""
        message = "`stamp` is not available in an action"
        help_ = "use a field with the time stamp, such as `hand.header.stamp`"
        self.context.fail(codes.UNKNOWN_BRIDGE_NAME, name.span, message, help_)

"""Actions of a bridge: goals that become commands, and states that decide how they end."""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.model.bridge_ports import BridgeInput, BridgePort
from robocomp_dsl.model.bridge_values import BuiltValue, Expression
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class Compared(Expression):
    """`left operator right`, a bool. Both are numbers of one unit, or of one other type."""

    operator: str
    left: Expression
    right: Expression


Condition: TypeAlias = tuple[Expression, ...]
"""Bool expressions, all of which must be true."""


class ActionCommand(Record):
    """A message that is sent when a goal is accepted, or `is_on_cancel`: when it is stopped.

    A goal is stopped if its client cancels it and if it takes too long.
    """

    name: str
    port: BridgePort
    arguments: tuple[BuiltValue, ...]
    is_on_cancel: bool


class BridgeAction(Record):
    """An action server. `goal`, `cancel`, `status`, `feedback` and `result` are its topics.

    `feedback_value` and `result_value` build the parts of those messages that the action declares;
    they and the conditions use the goal (an `InputValue` of `goal`) and the newest messages of
    `states` since the commands were sent. `timeout_s` 0: none.
    """

    name: str
    goal: BridgeInput
    cancel: BridgeInput
    status: BridgePort
    feedback: BridgePort
    result: BridgePort
    commands: tuple[ActionCommand, ...]
    states: tuple[BridgeInput, ...]
    feedback_value: BuiltValue
    result_value: BuiltValue
    succeed: tuple[Condition, ...]
    abort: tuple[Condition, ...]
    timeout_s: float
    span: Span
    doc: str = ""

    @property
    def inputs(self) -> tuple[BridgeInput, ...]:
        """All topics that it receives."""
        return (self.goal, self.cancel, *self.states)

    @property
    def sent(self) -> tuple[BridgePort, ...]:
        """The ports of all messages that it sends."""
        commands = (command.port for command in self.commands)
        return (self.status, self.feedback, self.result, *commands)

    @property
    def ports(self) -> tuple[BridgePort, ...]:
        """All ports, in order."""
        return (*(item.port for item in self.inputs), *self.sent)

"""Actions: their topics, commands, states, feedback, result and conditions.

In: the tree of an action. Out: a `BridgeAction`, and findings.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.bdsl.action_scope import ActionScope
from robocomp_dsl.check.bdsl.action_types import ActionTypes, action_types
from robocomp_dsl.check.bdsl.assignments import build_values
from robocomp_dsl.check.bdsl.conditions import resolve_condition
from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.declarations import check_names, input_of
from robocomp_dsl.check.bdsl.operations import PortKind, own_topic, used_operation
from robocomp_dsl.check.bdsl.outputs import message_of
from robocomp_dsl.check.bdsl.ports import bridge_port, port_middleware
from robocomp_dsl.check.bdsl.type_refs import UnitType
from robocomp_dsl.check.codes import bridge_actions as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.model.bridge_actions import ActionCommand, BridgeAction, Condition
from robocomp_dsl.model.bridge_ports import BridgeInput, BridgePort
from robocomp_dsl.model.bridge_values import BuiltValue
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import Struct
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Text

LONGEST_S = 24 * 60 * 60.0
_PARTS = ("feedback", "result")
_TOPICS = 5


def resolve_action(tree: ast.Action, context: BridgeContext) -> BridgeAction | None:
    """An action; None if it is faulty."""
    is_placed, is_complete = _check_place(tree, context), _check_parts(tree, context)
    types = action_types(tree.type, context)
    if types is None or not is_placed:
        return None
    topics = _Topics(tree, types, context)
    states: dict[str, BridgeInput | None] = {}
    valid = check_names((*tree.commands, *tree.states), context, reserved=("goal",))
    goal = Param("goal", types.goal, tree.type.span)
    every_state = [state.name.text for state in tree.states]
    before = ActionScope(context, goal, {}, every_state)
    commands = [_command(c, tree, before) for c in tree.commands if id(c) in valid]
    for state in tree.states:
        if id(state) in valid:
            states[state.name.text] = _state(state, tree, context)
    scope = ActionScope(context, goal, states)
    values = _values(tree, types, scope)
    succeed = [resolve_condition(condition, scope) for condition in tree.succeed]
    abort = [resolve_condition(condition, scope) for condition in tree.abort]
    parts: list[object] = [*commands, *states.values(), *succeed, *abort, *topics.ports]
    count = len(tree.commands) + len(tree.states)
    if values is None or None in parts or len(commands) + len(states) != count:
        return None
    if not is_complete or len(topics.ports) != _TOPICS:
        return None
    goal_port, cancel_port, status, feedback, result = topics.ports
    return BridgeAction(
        tree.name.text,
        _topic_input(goal_port),
        _topic_input(cancel_port),
        status,
        feedback,
        result,
        tuple(command for command in commands if command),
        tuple(state for state in states.values() if state),
        values[0],
        values[1],
        _present(succeed),
        _present(abort),
        tree.timeout.seconds if tree.timeout else 0.0,
        tree.name.span,
        tree.doc,
    )


def _present(conditions: Iterable[Condition | None]) -> tuple[Condition, ...]:
    return tuple(condition for condition in conditions if condition is not None)


class _Topics:
    """The five topics of an action, below its address."""

    def __init__(self, tree: ast.Action, types: ActionTypes, context: BridgeContext) -> None:
        self._tree = tree
        self._context = context
        self.ports: list[BridgePort] = []
        for word, kind, struct in (
            ("goal", PortKind.INPUT, types.goal_topic),
            ("cancel", PortKind.INPUT, types.cancel),
            ("status", PortKind.OUTPUT, types.status),
            ("feedback", PortKind.OUTPUT, types.feedback_topic),
            ("result", PortKind.OUTPUT, types.result_topic),
        ):
            port = self._port(word, kind, struct)
            if port is None:
                return
            self.ports.append(port)

    def _port(self, word: str, kind: PortKind, struct: Struct) -> BridgePort | None:
        tree, context = self._tree, self._context
        name = Name(tree.name.span, f"{tree.name.text}_{word}")
        address = tree.place.address
        whole = Text(address.span, f"{address.value.rstrip('/')}/{word}") if address else None
        place = ast.Place(tree.place.span, tree.place.middleware, whole)
        used = own_topic(kind, name, UnitType(struct, ""), tree.type.span, context)
        return bridge_port(kind, name, place, used, context, owner=tree.name.text)


def _topic_input(port: BridgePort) -> BridgeInput:
    return BridgeInput(port.name, port, port.operation.inputs[0].type, "")


def _check_place(tree: ast.Action, context: BridgeContext) -> bool:
    """Whether the middleware carries actions, and the action has an address."""
    known = context.workspace.middlewares
    name = port_middleware(tree.place, context)
    description = known.describe(name) if name else None
    if not name:
        return False
    if description is not None and not description.capabilities.actions:
        described = [known.describe(other) for other in known.names()]
        able = join_names([d.name for d in described if d and d.capabilities.actions])
        context.report.add(
            codes.ACTION_TYPE,
            tree.place.middleware.span if tree.place.middleware else tree.name.span,
            f"a bridge has no actions over `{name}`",
            help=f"only {able} carries actions; over `{name}`, receive the goal as an `input` or "
            "`service`, and send the state as an `output`",
        )
        return False
    if tree.place.address is not None:
        return True
    context.report.add(
        codes.ACTION_TYPE,
        tree.name.span,
        f"the action `{tree.name.text}` has no address",
        help=f'write `over {name} at "/{tree.name.text}"`',
    )
    return False


def _check_parts(tree: ast.Action, context: BridgeContext) -> bool:
    """Whether goals can be reached: with a command, a state and a condition."""
    missing = []
    if all(command.is_on_cancel for command in tree.commands):
        missing.append("a `command` for its goal")
    if not tree.states:
        missing.append("a `state`")
    if not tree.succeed:
        missing.append("a condition `succeed when …;`")
    if missing and context.is_complete:
        message = f"the action `{tree.name.text}` needs {' and '.join(missing)}"
        context.report.add(codes.INCOMPLETE_ACTION, tree.name.span, message)
    timeout = tree.timeout
    if timeout is not None and not 0 < timeout.seconds <= LONGEST_S:
        message = f"`timeout` is above 0 and up to a day, not `{timeout.span.text}`"
        context.report.add(codes.INCOMPLETE_ACTION, timeout.span, message)
        return False
    return not missing


def _command(tree: ast.Command, action: ast.Action, scope: ActionScope) -> ActionCommand | None:
    output = ast.Output(tree.span, tree.name, tree.type, tree.place, fields=tree.fields)
    found = message_of(output, scope)
    if found is None:
        return None
    used, arguments = found
    owner = action.name.text
    port = bridge_port(PortKind.OUTPUT, tree.name, tree.place, used, scope.context, owner=owner)
    if arguments is None or port is None:
        return None
    return ActionCommand(tree.name.text, port, arguments, tree.is_on_cancel)


def _state(tree: ast.Input, action: ast.Action, context: BridgeContext) -> BridgeInput | None:
    used = used_operation(PortKind.INPUT, tree.name, tree.type, context)
    if used is None:
        return None
    port = bridge_port(
        PortKind.INPUT, tree.name, tree.place, used, context, tree.qos, action.name.text
    )
    return input_of(tree, port, context).replace(name=port.name) if port else None


def _values(
    tree: ast.Action, types: ActionTypes, scope: ActionScope
) -> tuple[BuiltValue, ...] | None:
    """The values of feedback and result."""
    is_valid = True
    fields = []
    for field in tree.fields:
        first = field.path.parts[0].name
        if first.text in _PARTS:
            fields.append(field)
            continue
        is_valid = False
        scope.context.report.add(
            codes.ACTION_FIELD,
            first.span,
            f"an action has a feedback and a result, and no `{first.text}`",
            help=f"write `feedback.{field.path.text} = …;` or `result.{field.path.text} = …;`",
        )
    span = tree.type.span
    params = (Param("feedback", types.feedback, span), Param("result", types.result, span))
    values = build_values(params, fields, scope)
    return values if is_valid else None

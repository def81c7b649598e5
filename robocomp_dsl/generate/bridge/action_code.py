"""The specification of an action in `bridge_worker.py`.

In: an action and the functions of `mapping.py`. Out: calls of `ActionSpec` and of its parts.
"""

from __future__ import annotations

from robocomp_dsl.generate.bridge.action_functions import command_function
from robocomp_dsl.generate.bridge.bridge_names import BridgeNames, struct_of
from robocomp_dsl.generate.bridge.mapping import MappingCode
from robocomp_dsl.generate.bridge.places import place, places_text, tuple_text
from robocomp_dsl.generate.literals import python_value, quoted
from robocomp_dsl.model.bridge_actions import ActionCommand, BridgeAction
from robocomp_dsl.model.bridge_ports import BridgePort


def action_code(action: BridgeAction, names: BridgeNames, mapping: MappingCode) -> str:
    """`ActionSpec(…)`."""
    feedback = mapping.function(f"action_{action.name}_feedback")
    result = mapping.function(f"action_{action.name}_result")
    conditions = [f"action_{action.name}_succeeds"]
    conditions += [f"action_{action.name}_aborts"] if action.abort else []
    places = dict(feedback.places) | dict(result.places)
    for name in conditions:
        places |= dict(mapping.function(name).places)
    parts = [
        quoted(action.name),
        quoted(place(action.span)),
        f"goal={quoted(action.goal.name)}",
        f"cancel={quoted(action.cancel.name)}",
        f"states={tuple_text(quoted(state.name) for state in action.states)}",
        f"status={_topic(action.status, names)}",
        f"feedback={_topic(action.feedback, names)}",
        f"result={_topic(action.result, names)}",
        f"commands={tuple_text(_command(action, c, mapping) for c in action.commands)}",
        f"build_feedback=mapping.{feedback.name}",
        f"build_result=mapping.{result.name}",
        f"succeeds=mapping.action_{action.name}_succeeds",
        f"places={places_text(tuple(places.items()))}",
    ]
    parts += [f"aborts=mapping.action_{action.name}_aborts"] if action.abort else []
    parts += [f"timeout={python_value(float(action.timeout_s))}"] if action.timeout_s else []
    return f"ActionSpec({', '.join(parts)})"


def _topic(port: BridgePort, names: BridgeNames) -> str:
    message = names.type_name(struct_of(port.operation.inputs[0].type))
    return f"ActionTopicSpec({quoted(port.name)}, {quoted(port.operation.name)}, {message})"


def _command(action: BridgeAction, command: ActionCommand, mapping: MappingCode) -> str:
    function = mapping.function(command_function(action, command))
    port = command.port
    parts = [*map(quoted, (command.name, port.name, port.operation.name))]
    parts += [f"mapping.{function.name}", places_text(function.places)]
    parts += ["is_on_cancel=True"] if command.is_on_cancel else []
    return f"CommandSpec({', '.join(parts)})"

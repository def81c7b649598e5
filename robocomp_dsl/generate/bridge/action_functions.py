"""The functions of `mapping.py` for an action: commands, feedback, result and conditions.

In: an action and the names of its bridge. Out: `MappingFunction`s. Each takes the goal; those other
than of commands also take the newest messages of the states.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.built_values import BuiltLines, value_lines
from robocomp_dsl.generate.bridge.expressions import ExpressionPrinter
from robocomp_dsl.generate.bridge.places import place
from robocomp_dsl.generate.bridge.received_messages import (
    CONTEXT,
    MappingFunction,
    annotation_of,
    input_locals,
)
from robocomp_dsl.generate.literals import quoted
from robocomp_dsl.generate.names import unique
from robocomp_dsl.model.bridge_actions import ActionCommand, BridgeAction, Condition
from robocomp_dsl.model.bridge_values import BuiltValue
from robocomp_dsl.model.types import Struct

_GOAL = {("", "goal"): "goal"}


def action_functions(action: BridgeAction, names: BridgeNames) -> Iterator[MappingFunction]:
    """All functions of an action."""
    for command in action.commands:
        yield _command(action, command, names)
    yield _part(action, action.feedback_value, names)
    yield _part(action, action.result_value, names)
    yield _conditions(action, "succeeds", action.succeed, names)
    if action.abort:
        yield _conditions(action, "aborts", action.abort, names)


def command_function(action: BridgeAction, command: ActionCommand) -> str:
    """The name of the function that builds a command."""
    return f"action_{action.name}_command_{command.name}"


def _goal(action: BridgeAction, names: BridgeNames) -> str:
    """The parameter `goal` with its type: the field of the message of the goal's topic."""
    message = action.goal.type
    kind = "Any"
    if isinstance(message, Struct):
        kind = names.annotation(next(f.type for f in message.fields if f.name == "goal"))
    return f"goal: {kind}"


def _command(action: BridgeAction, command: ActionCommand, names: BridgeNames) -> MappingFunction:
    single = len(command.arguments) == 1
    built = BuiltLines(ExpressionPrinter(names, _GOAL), names, single=single)
    variables = unique([f"argument_{value.param.name}" for value in command.arguments])
    results = [
        value_lines(value, "message" if single else variable, built)
        for value, variable in zip(command.arguments, variables, strict=True)
    ]
    kinds = [names.annotation(parameter.type) for parameter in command.port.operation.inputs]
    where = place(command.port.span)
    return MappingFunction(
        command_function(action, command),
        ", ".join((*CONTEXT, _goal(action, names))),
        f"tuple[{', '.join(kinds) or '()'}]",
        f"The command `{command.name}` of the action `{action.name}` ({where}).",
        (*built.lines, f"return ({', '.join(results)}{',' * single})"),
        tuple(dict([("", where), *built.places]).items()),
    )


def _part(action: BridgeAction, value: BuiltValue, names: BridgeNames) -> MappingFunction:
    word = value.param.name
    printer, parameters, lines = _with_states(action, names)
    built = BuiltLines(printer, names, single=True, prefix=f"{word}.")
    variable = value_lines(value, "message", built)
    where = place(action.span)
    return MappingFunction(
        f"action_{action.name}_{word}",
        parameters,
        names.annotation(value.param.type),
        f"The {word} of the action `{action.name}` ({where}).",
        (*lines, *built.lines, f"return {variable}"),
        tuple(dict([("", where), *built.places]).items()),
    )


def _conditions(
    action: BridgeAction, word: str, conditions: tuple[Condition, ...], names: BridgeNames
) -> MappingFunction:
    printer, parameters, lines = _with_states(action, names)
    places, tests = [("", place(action.span))], list[str]()
    for index, condition in enumerate(conditions):
        field = f"{word.removesuffix('s')} when{f' ({index + 1})' * (index > 0)}"
        places.append((field, place(condition[0].span)))
        tests.append(f"at.field = {quoted(field)}")
        text = " and ".join(printer.text(part) for part in condition)
        if condition is conditions[-1]:
            tests.append(
                f"return {printer.statement(condition[0]) if len(condition) == 1 else text}"
            )
        else:
            tests += [f"if {text}:", "    return True"]
    return MappingFunction(
        f"action_{action.name}_{word}",
        parameters,
        "bool",
        f"Whether a goal of the action `{action.name}` {word} ({place(condition[0].span)}).",
        (*lines, *tests),
        tuple(dict(places).items()),
    )


def _with_states(
    action: BridgeAction, names: BridgeNames
) -> tuple[ExpressionPrinter, str, list[str]]:
    """The printer, the parameters, and the lines that unpack states of several parameters."""
    local_names, lines = input_locals(action.states, names)
    states = [f"{names.variables[s.name]}: {annotation_of(s, names)}" for s in action.states]
    parameters = ", ".join((*CONTEXT, _goal(action, names), *states))
    return ExpressionPrinter(names, local_names | _GOAL), parameters, lines

"""The messages of an action, which ROS generates from its definition.

In: the type of an action. Out: the structs of its goal, result and feedback and of its topics.
"""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.type_refs import service_part
from robocomp_dsl.check.codes import bridge_actions as codes
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.loaded import transitive_errors
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.model.types import Struct
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Import, Text


class ActionTypes(Record):
    """The messages of the five topics, and what the action declares in three of them."""

    goal_topic: Struct
    result_topic: Struct
    feedback_topic: Struct
    goal: Struct
    result: Struct
    feedback: Struct
    cancel: Struct
    status: Struct


def action_types(ref: ast.TypeRef, context: BridgeContext) -> ActionTypes | None:
    """The types of an action, or None and a finding."""
    name = ref.name
    if name is None or ref.lengths or ref.unit or ref.operation:
        help_ = "write such as `my_msgs::Grasp`, from an imported `.action` file"
        message = "the type of an action is a ROS action"
        context.report.add(codes.ACTION_TYPE, ref.span, message, help=help_)
        return None
    found = context.scope.lookup(service_part(name, "Goal"), Struct)
    if not found or "/action/" not in found[0].ros_name:
        _report_unknown(ref, context)
        return None
    package, _, stem = found[0].ros_name.split("/")
    stem = stem.removesuffix("_Goal")
    parts = [f"Action{part}" for part in ("Goal", "Result", "Feedback")]
    parts += ["Goal", "Result", "Feedback"]
    written = [f"{package}/msg/{stem}{part}.msg" for part in parts]
    written += ["actionlib_msgs/msg/GoalID.msg", "actionlib_msgs/msg/GoalStatusArray.msg"]
    structs = [_load(text, ref.span, context) for text in written]
    valid = [struct for struct in structs if struct is not None]
    return ActionTypes(*valid) if len(valid) == len(structs) else None


def _load(written: str, span: Span, context: BridgeContext) -> Struct | None:
    """The message in a definition, as if the bridge imported it."""
    statement = Import(span, Text(span, written))
    links = context.workspace.modules.resolve_imports((statement,), context.report)
    context.report.extend(transitive_errors(links))
    loaded = links[0].loaded
    if loaded is None or not loaded.modules:
        return None
    context.further_modules.extend(loaded.modules)
    name = written.rpartition("/")[2].removesuffix(".msg")
    structs = (d for d in loaded.modules[0].declarations if isinstance(d, Struct))
    return next((struct for struct in structs if struct.name == name), None)


def _report_unknown(ref: ast.TypeRef, context: BridgeContext) -> None:
    name = ref.name
    if name is None or context.scope.is_follow_on_error(name, None):
        return
    if context.scope.lookup(name, Struct) or context.scope.lookup(
        service_part(name, "Request"), Struct
    ):
        context.report.add(
            codes.ACTION_TYPE,
            ref.span,
            f"`{name.text}` is no action: an action has a goal, a result and feedback",
            help="its type comes from an imported `.action` file",
        )
        return
    known = [
        declared.qualified.removesuffix("_Goal")
        for declared in context.scope.declarations(Struct)
        if declared.name.endswith("_Goal")
    ]
    guess = nearest(name.text, known)
    context.report.add(
        codes.ACTION_TYPE,
        ref.span,
        f"no import declares the action `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help="an action comes from an imported `.action` file",
        fix=replace_fix(ref.span, guess) if guess else None,
    )

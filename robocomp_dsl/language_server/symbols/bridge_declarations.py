"""The names in a bridge and what they stand for: inputs, hubs, functions, requests and replies.

In: the trees and models of a BDSL file. Out: the object behind a name or a path such as
`imu.angular_velocity.z`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.language_server.symbols.bridge_types import DeclaredTypes, element_of, member_of
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_actions import BridgeAction
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput
from robocomp_dsl.model.bridge_values import BridgeCall, BridgeHub, Expression
from robocomp_dsl.syntax.ast import bdsl as ast


class BridgeDeclarations:
    """The declarations of some versions of one bridge; the first version that has a name counts."""

    def __init__(
        self, bridges: Sequence[Bridge], trees: Sequence[ast.Bridge], declared: DeclaredTypes
    ) -> None:
        self._bridges = bridges
        self._trees = trees
        self.declared = declared

    def values(self) -> dict[str, BridgeInput | BridgeHub | None]:
        """The inputs and hubs by name; None for one with errors."""
        named: dict[str, BridgeInput | BridgeHub | None] = {}
        for bridge in reversed(self._bridges):
            named |= {value.name: value for value in bridge.inputs}
            named |= {value.name: value for value in bridge.hubs}
        for tree in self._trees:
            for name in (*(i.name for i in tree.inputs), *(h.name for h in tree.hubs)):
                named.setdefault(name.text, None)
        return named

    def functions(self) -> dict[str, BridgeFunction]:
        """The functions of the user by name."""
        return {f.name: f for bridge in reversed(self._bridges) for f in bridge.functions}

    def outputs(self) -> dict[str, BridgeOutput]:
        """The outputs without errors by name."""
        return {o.name: o for bridge in reversed(self._bridges) for o in bridge.outputs}

    def services(self) -> dict[str, BridgeService]:
        """The services without errors by name."""
        return {s.name: s for bridge in reversed(self._bridges) for s in bridge.services}

    def calls(self, service: str) -> dict[str, BridgeCall]:
        """The calls without errors of a service by name."""
        own = self.services().get(service)
        return {call.name: call for call in own.calls} if own else {}

    def call_trees(self, service: str) -> dict[str, ast.Call]:
        """The calls of a service as written, by name."""
        own = self._service_tree(service)
        return {call.name.text: call for call in own.calls} if own else {}

    def root(self, name: str, service: str = "") -> object:
        """What a name in an expression stands for; None if it is unknown or has no fields.

        `service` is the service or action that contains the expression.
        """
        if not service:
            model = self.values().get(name)
            trees = (i for tree in self._trees for i in tree.inputs if i.name.text == name)
            written = next(trees, None)
            return model or (self.declared.message(written.type) if written else None)
        action = self.action_tree(service)
        if action:
            if name == "goal":
                return self.declared.action_part(action.type, "Goal")
            state = next((s for s in action.states if s.name.text == name), None)
            return self.declared.message(state.type) if state else None
        own = self._service_tree(service)
        if name == "request":
            return self.declared.request(own.type) if own else None
        call = self.call_trees(service).get(name)
        return self.declared.reply(call.type) if call else None

    def resolve(self, expression: ast.Expression, service: str = "") -> object:
        """The object or type of an expression that is a path; None for any other."""
        match expression:
            case ast.Reference(name=name):
                return self.root(name.text, service)
            case ast.Member(value=value, name=name):
                member = member_of(self.resolve(value, service), name.text)
                return member.type if member else None
            case ast.Selection(value=value, indices=indices):
                selected = self.resolve(value, service)
                return element_of(selected) if len(indices) == 1 else selected
        return None

    def action_tree(self, name: str) -> ast.Action | None:
        """The action called `name`."""
        actions = (a for tree in self._trees for a in tree.actions if a.name.text == name)
        return next(actions, None)

    def actions(self) -> dict[str, BridgeAction]:
        """The actions without errors by name."""
        return {a.name: a for bridge in reversed(self._bridges) for a in bridge.actions}

    def _service_tree(self, name: str) -> ast.Service | None:
        services = (s for tree in self._trees for s in tree.services if s.name.text == name)
        return next(services, None)


def expressions_of(bridge: Bridge) -> Iterator[Expression]:
    """All typed expressions of a bridge, the outermost first."""
    calls = [call for service in bridge.services for call in service.calls]
    built = [value for output in bridge.outputs for value in output.arguments]
    built += [value for call in calls for value in call.arguments]
    built += [value for service in bridge.services for value in service.reply]
    for action in bridge.actions:
        built += [value for command in action.commands for value in command.arguments]
        built += [action.feedback_value, action.result_value]
    roots = [value for hub in bridge.hubs for value in hub.values]
    roots += [value.value for value in built if value.value is not None]
    conditions = (c for a in bridge.actions for c in (*a.succeed, *a.abort))
    roots += [comparison for condition in conditions for comparison in condition]
    roots += [assignment.value for value in built for assignment in value.assignments]
    for root in roots:
        yield from root.walk()

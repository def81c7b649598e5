"""Services: the calls that a service makes, and its reply.

In: tree nodes. Out: `BridgeService` values, and findings.
"""

from __future__ import annotations

from robocomp_dsl.check.bdsl.assignments import build_values, check_missing
from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.declarations import check_names
from robocomp_dsl.check.bdsl.operations import PortKind, used_operation
from robocomp_dsl.check.bdsl.ports import bridge_port
from robocomp_dsl.check.bdsl.scopes import ServiceScope, reply_parameters
from robocomp_dsl.model.bridge import BridgeService
from robocomp_dsl.model.bridge_values import BridgeCall
from robocomp_dsl.syntax.ast import bdsl as ast


def resolve_service(tree: ast.Service, context: BridgeContext) -> BridgeService | None:
    """A service; None if it is faulty."""
    used = used_operation(PortKind.SERVICE, tree.name, tree.type, context)
    if used is None:
        return None
    port = bridge_port(PortKind.SERVICE, tree.name, tree.place, used, context)
    calls: dict[str, BridgeCall | None] = {}
    every_call = [call.name.text for call in tree.calls]
    scope = ServiceScope(context, used.operation.inputs, calls, every_call)
    valid = check_names(tree.calls, context)
    for call in tree.calls:
        if id(call) in valid:
            calls[call.name.text] = _call(call, tree.name.text, scope)
    reply = build_values(reply_parameters(used.operation), tree.fields, scope)
    resolved = [call for call in calls.values() if call is not None]
    if port is None or reply is None or len(resolved) != len(tree.calls):
        return None
    return BridgeService(tree.name.text, port, tuple(resolved), reply, tree.doc)


def _call(tree: ast.Call, service: str, scope: ServiceScope) -> BridgeCall | None:
    """A call of `service`, whose arguments use the request and earlier calls."""
    used = used_operation(PortKind.CALL, tree.name, tree.type, scope.context)
    if used is None:
        return None
    port = bridge_port(PortKind.CALL, tree.name, tree.place, used, scope.context, owner=service)
    params = used.operation.inputs
    arguments = build_values(params, tree.fields, scope)
    if port is None or arguments is None:
        return None
    if not used.is_own and not check_missing(params, arguments, tree, scope.context.report):
        return None
    return BridgeCall(tree.name.text, port, arguments)

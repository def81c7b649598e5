"""Ports of a bridge: operation, middleware, address and quality of service.

In: the type and place of an input, output, service or call. Out: a `BridgePort`, and findings.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.operations import PortKind, UsedOperation
from robocomp_dsl.check.cdsl.middlewares import DEFAULT, find_middleware
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.codes import connections as connection_codes
from robocomp_dsl.check.ddsl.carriers import QOS_WORDS, required_qos
from robocomp_dsl.check.ddsl.qos import qos_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Code
from robocomp_dsl.model.bridge_ports import BridgePort
from robocomp_dsl.model.component import Role
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.ast.ddsl import Qos as QosTree

if TYPE_CHECKING:
    from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

_COMPONENT = re.compile(r"[A-Za-z_][\w-]*(/[A-Za-z_][\w-]*)*")


class _Problem(ValueRecord):
    """Why a middleware cannot carry a port."""

    code: Code
    message: str


def bridge_port(
    kind: PortKind,
    name: Name,
    place: ast.Place,
    used: UsedOperation,
    context: BridgeContext,
    qos_tree: QosTree | None = None,
    owner: str = "",
) -> BridgePort | None:
    """The port, or None if its middleware is unknown or unable; `owner`: the service of a call."""
    middleware = port_middleware(place, context)
    qos = qos_of(qos_tree, context.report)
    if not middleware:
        return None
    port = BridgePort(
        context.call_name(name.text, owner) if owner else name.text,
        used.role,
        used.interface,
        used.operation,
        middleware,
        place.address.value.strip() if place.address else "",
        qos,
        name.span,
        used.is_own,
    )
    description = context.workspace.middlewares.describe(middleware)
    if description is None:
        return port
    over = place.middleware.span if place.middleware else name.span
    is_able = _check_capabilities(port, description.capabilities, over, context)
    _check_qos(port, description.capabilities, qos_tree, context)
    is_valid = _check_address(kind, port, place, description, context)
    return port if is_able and is_valid else None


def port_middleware(place: ast.Place, context: BridgeContext) -> str:
    """The middleware of `over`, else of the bridge; empty for an unknown one."""
    if place.middleware is None:
        return context.middleware or DEFAULT
    return find_middleware(place.middleware, context.workspace.middlewares, context.report)


def _able(can: Callable[[Capabilities], bool], context: BridgeContext) -> str:
    known = context.workspace.middlewares
    described = ((name, known.describe(name)) for name in known.names())
    names = [name for name, found in described if found and can(found.capabilities)]
    return f"{join_names(names)} can carry it" if names else ""


def _check_capabilities(
    port: BridgePort, capabilities: Capabilities, span: Span, context: BridgeContext
) -> bool:
    problems = list(_problems(port, capabilities))
    help_ = _able(lambda other: not any(_problems(port, other)), context) if problems else ""
    for problem in problems:
        context.report.add(problem.code, span, problem.message, help=help_)
    return not problems


def _problems(port: BridgePort, capabilities: Capabilities) -> Iterator[_Problem]:
    code = connection_codes.UNSUITABLE_MIDDLEWARE
    name = port.middleware
    if not capabilities.between_processes:
        yield _Problem(code, f"`{name}` cannot connect processes, and a bridge is a process")
    if port.role.is_topic and not capabilities.topics:
        yield _Problem(code, f"`{name}` has no topics")
    if not port.role.is_topic and not capabilities.services:
        yield _Problem(code, f"`{name}` has no services")
    if capabilities.valid_names and not re.fullmatch(capabilities.valid_names, port.name):
        yield _Problem(code, f"`{port.name}` is not a valid name over `{name}`")
    if capabilities.ros_types_only:
        is_topic = port.role.is_topic
        operation = port.operation
        if not (operation.ros_topic if is_topic else operation.ros_service):
            needed = "an imported `.msg`" if is_topic else "an imported `.srv`"
            yield _Problem(code, f"`{name}` carries ROS types only: `{port.name}` needs {needed}")


def _check_qos(
    port: BridgePort, capabilities: Capabilities, tree: QosTree | None, context: BridgeContext
) -> None:
    if tree is None:
        return
    is_topic = port.role.is_topic
    for item, word in QOS_WORDS.items():
        if not is_topic and getattr(port.qos, item):
            message = f"`{word}` is for topics; `{port.name}` is a service interface here"
            context.report.add(
                connection_codes.UNSUPPORTED_QOS, tree.span, message, help="remove it"
            )
    if port.qos.keep_all and port.qos.reliable is False:
        message = "`keep all` delivers every message, `best_effort` may lose some"
        context.report.add(
            connection_codes.UNSUPPORTED_QOS, tree.span, message, help="remove one of them"
        )
    for item in required_qos(port.qos, is_topic=is_topic):
        if item not in capabilities.qos:
            context.report.add(
                connection_codes.UNSUPPORTED_QOS,
                tree.span,
                f"`{port.middleware}` does not honour `{QOS_WORDS.get(item, item)}`",
                help=_able(lambda other, item=item: item in other.qos, context),  # type: ignore[misc]
            )


def _check_address(
    kind: PortKind,
    port: BridgePort,
    place: ast.Place,
    description: MiddlewareDescription,
    context: BridgeContext,
) -> bool:
    if place.address is None:
        if kind is PortKind.CALL and description.capabilities.external_peers:
            context.report.add(
                codes.BRIDGE_ADDRESS,
                port.span,
                f"the call `{port.name}` has no address over `{port.middleware}`",
                help=f'write `over {port.middleware} at "…"`',
            )
            return False
        return True
    problem = _address_problem(port, description)
    if problem:
        context.report.add(codes.BRIDGE_ADDRESS, place.address.span, problem)
    return not problem


def _address_problem(port: BridgePort, description: MiddlewareDescription) -> str:
    if not port.address:
        return "the address is empty"
    if not description.capabilities.external_peers:
        if port.role in (Role.PUBLISHES, Role.IMPLEMENTS):
            return (
                f"over `{description.name}` other components look for `{port.name}`: remove `at`,"
                " and connect them to this bridge"
            )
        if _COMPONENT.fullmatch(port.address):
            return ""
        return (
            f"`{description.name}` connects components only: `at` names one, such as `base`, "
            f"not `{port.address}`"
        )
    if not description.address_problem:
        return ""
    return _address_check(description.address_problem)(port.address)


@cache
def _address_check(name: str) -> Callable[[str], str]:
    """The function `module:function` of a middleware: the problem of an address, or ""."""
    module, _, function = name.partition(":")
    check: Callable[[str], str] = getattr(import_module(module), function)
    return check

"""Checks that a middleware can carry each connection, with its quality of service.

In: connections, and what middlewares can do. Out: diagnostics. A middleware is known by its
capabilities only.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.ddsl.host_connections import needs_hosts_connected
from robocomp_dsl.check.ddsl.sender_monitors import check_sender_monitors
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Code, Fix, Note, Report
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.deployment import UNPLACED, Connection, External, Host, Instance, Qos
from robocomp_dsl.model.interface import Pattern
from robocomp_dsl.model.port_middlewares import (
    connection_middleware,
    declared_middlewares,
    shared_middlewares,
)
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Span

if TYPE_CHECKING:
    from robocomp_dsl.runtime.middleware.capabilities import Capabilities

QOS_WORDS = {
    "keep_all": "keep all",
    "latched": "latched",
    "deadline_ms": "deadline",
    "liveliness_ms": "liveliness",
}
"""The items of `Qos` that are for topics only, and how users write them."""


class _Problem(ValueRecord):
    """Why a middleware cannot carry a connection."""

    code: Code
    message: str


def check_deployment_middleware(
    name: str, span: Span, known: KnownMiddlewares, report: Report
) -> str:
    """The middleware of the deployment; empty if it cannot connect processes."""
    description = known.describe(name)
    if description is None or description.capabilities.between_processes:
        return name
    able = _able(lambda capabilities: capabilities.between_processes, known)
    report.add(
        codes.UNSUITABLE_MIDDLEWARE,
        span,
        f"`{name}` cannot connect processes, and each component is a process",
        help=f"remove it, or use {join_names(able)}",
    )
    return ""


def check_carriers(
    connections: Sequence[Connection],
    deployment: str,
    hosts: Mapping[str, Host],
    known: KnownMiddlewares,
    report: Report,
) -> None:
    """Check every connection; `deployment` is the middleware of the file, or empty."""
    for connection in connections:
        _check_topic_qos(connection, report)
        if not _is_plain(connection, deployment):
            between_hosts = needs_hosts_connected(connection, hosts)
            _check(connection, deployment, known, report, between_hosts=between_hosts)
    check_sender_monitors(connections, report)


def _is_plain(connection: Connection, deployment: str) -> bool:
    """Whether nothing is said about it, so that the default middleware carries it."""
    ends = (
        (connection.source, connection.source_port),
        (connection.target, connection.target_port),
    )
    return (
        not deployment
        and not connection_middleware(connection)
        and connection.qos == Qos()
        and not any(_says_middleware(instance, port) for instance, port in ends)
    )


def _says_middleware(instance: Instance, port: Port) -> bool:
    written = instance.component.middleware_span is not None
    return bool(written or port.middlewares or instance.middleware or instance.own_ports)


def _check(
    connection: Connection,
    deployment: str,
    known: KnownMiddlewares,
    report: Report,
    *,
    between_hosts: bool,
) -> None:
    if _contradicts_external(connection, report):
        return
    names = shared_middlewares(connection, deployment)
    if not names:
        _report_none_shared(connection, deployment, report)
        return
    problems: list[_Problem] = []
    for name in names:
        description = known.describe(name)
        if description is None:
            return  # it cannot be loaded: nothing is known of it
        found = list(_problems(connection, name, description.capabilities, between_hosts))
        if not found:
            return
        problems = problems or found
    able = _able(lambda other: not any(_problems(connection, "", other, between_hosts)), known)
    fix = _replace_middleware(connection, able)
    for problem in problems:
        report.add(
            problem.code,
            connection.middleware_span or connection.span,
            problem.message,
            help=_can_carry(connection, able),
            fix=fix if problem is problems[0] else None,
        )


def _can_carry(connection: Connection, able: Sequence[str]) -> str:
    if not able:
        return ""
    text = f"{join_names(able)} can carry it"
    if connection.middleware_span or connection.implied:
        return text
    ends = f"{connection.source.name}.{connection.source_port.name} -> "
    ends += f"{connection.target.name}.{connection.target_port.name}"
    return f"{text}: `connect {ends} over {_preferred(able)};`"


def _preferred(able: Sequence[str]) -> str:
    """The middleware that a component uses by default, if it is among `able`."""
    default = Component.defaults["middleware"]
    return default if default in able else able[0]


def _replace_middleware(connection: Connection, able: Sequence[str]) -> Fix | None:
    if connection.middleware_span is None or not able:
        return None
    return replace_fix(connection.middleware_span, _preferred(able))


def _able(can: Callable[[Capabilities], bool], known: KnownMiddlewares) -> list[str]:
    """The middlewares whose capabilities satisfy `can`."""
    described = ((name, known.describe(name)) for name in known.names())
    return [
        name for name, description in described if description and can(description.capabilities)
    ]


def _contradicts_external(connection: Connection, report: Report) -> bool:
    """Whether `over` names another middleware than that of an external end; reports it."""
    external = connection_middleware(connection)
    if connection.middleware in ("", external):
        return False
    ends = (connection.source, connection.target)
    program = next(end for end in ends if isinstance(end, External))
    report.add(
        codes.UNSUITABLE_MIDDLEWARE,
        connection.middleware_span or connection.span,
        f"`{program.name}` is reached over `{external}`, not over `{connection.middleware}`",
        notes=[Note(program.span, "it is declared here")],
        help="remove `over`",
    )
    return True


def _report_none_shared(connection: Connection, deployment: str, report: Report) -> None:
    source = declared_middlewares(connection.source, connection.source_port, deployment)
    target = declared_middlewares(connection.target, connection.target_port, deployment)
    report.add(
        codes.NO_SHARED_MIDDLEWARE,
        connection.span,
        f"`{connection.source.name}.{connection.source_port.name}` uses {join_names(source)}, "
        f"`{connection.target.name}.{connection.target_port.name}` uses {join_names(target)}",
        notes=[
            Note(connection.source_port.span, "one port is declared here"),
            Note(connection.target_port.span, "the other port is declared here"),
        ],
        help=f"choose one: `connect {connection.source.name}.{connection.source_port.name} -> "
        f"{connection.target.name}.{connection.target_port.name} over {target[0]};`",
    )


def _problems(
    connection: Connection, name: str, capabilities: Capabilities, between_hosts: bool
) -> Iterator[_Problem]:
    yield from _reach_problems(connection, name, capabilities, between_hosts)
    ends = (
        (connection.source, connection.source_port),
        (connection.target, connection.target_port),
    )
    for instance, port in ends:
        if not isinstance(instance, External):
            for word in (instance.full_name, port.name):
                if capabilities.valid_names and not re.fullmatch(capabilities.valid_names, word):
                    message = f"`{word}` is not a valid name over `{name}`"
                    yield _Problem(codes.UNSUITABLE_MIDDLEWARE, message)
    external = any(isinstance(instance, External) for instance, _ in ends)
    if capabilities.ros_types_only or (external and capabilities.external_ros_types):
        subject = f"`{name}` carries" if capabilities.ros_types_only else "programs of ROS know"
        yield from _ros_problems(connection.source_port, subject)
    for item in required_qos(connection.qos, is_topic=connection.source_port.role.is_topic):
        if item not in capabilities.qos:
            message = f"`{name}` does not honour `{QOS_WORDS.get(item, item)}`"
            yield _Problem(codes.UNSUPPORTED_QOS, message)


def _ros_problems(port: Port, subject: str) -> Iterator[_Problem]:
    """The operations of a port that ROS cannot express; `subject` is what needs ROS types."""
    for operation in port.interface.operations:
        is_topic = port.role.is_topic or operation.pattern is Pattern.COMMAND
        if not (operation.ros_topic if is_topic else operation.ros_service):
            types = (
                "a parameter that is one imported `.msg`"
                if is_topic
                else "the request and response of one imported `.srv`"
            )
            message = (
                f"{subject} ROS types only: `{operation.name}` of"
                f" `{port.interface.name}` needs {types}"
            )
            yield _Problem(codes.UNSUITABLE_MIDDLEWARE, message)


def _reach_problems(
    connection: Connection, name: str, capabilities: Capabilities, between_hosts: bool
) -> Iterator[_Problem]:
    code = codes.UNSUITABLE_MIDDLEWARE
    ends = (connection.source, connection.target)
    in_one_process = bool(ends[0].process) and ends[0].process == ends[1].process
    if not capabilities.between_processes and not in_one_process:
        message = f"`{name}` cannot connect processes, and each component is a process"
        yield _Problem(code, message)
    elif between_hosts and not capabilities.between_hosts:
        message = (
            f"`{name}` connects components of one machine; `{connection.source.name}` runs "
            f"{_where(connection.source)}, `{connection.target.name}` {_where(connection.target)}"
        )
        yield _Problem(code, message)
    if connection.source_port.role.is_topic and not capabilities.topics:
        yield _Problem(code, f"`{name}` has no topics")
    if not connection.source_port.role.is_topic and not capabilities.services:
        yield _Problem(code, f"`{name}` has no services")


def _where(instance: Instance) -> str:
    if instance.host is UNPLACED:
        return f"on one of {join_names(list(instance.placement.candidates))}"
    return f"on `{instance.host.name}`" if instance.host.machine else "on this machine"


def required_qos(qos: Qos, *, is_topic: bool) -> Iterator[str]:
    """The items of `QOS_ITEMS` that a middleware must honour."""
    if qos.reliable and is_topic:
        yield "reliable"
    if qos.keep_all and is_topic:
        yield "keep_all"
    if qos.latched and is_topic:
        yield "latched"
    if qos.priority not in (None, "normal"):
        yield "priority"


def _check_topic_qos(connection: Connection, report: Report) -> None:
    """Report items that exclude each other, or that are for topics only."""
    qos = connection.qos
    if qos.keep_all and qos.reliable is False:
        report.add(
            codes.UNSUPPORTED_QOS,
            connection.span,
            "`keep all` delivers every message, `best_effort` may lose some",
            help="remove one of them",
        )
    if connection.source_port.role.is_topic:
        return
    for item in QOS_WORDS:
        if getattr(qos, item):
            report.add(
                codes.UNSUPPORTED_QOS,
                connection.span,
                f"`{QOS_WORDS.get(item, item)}` is for topics; "
                f"`{connection.source_port.interface.name}` is a service here",
                help="remove it",
            )

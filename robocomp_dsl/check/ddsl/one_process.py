"""Checks the groups that run in one process (`inprocess`), and connects their components in it.

In: scopes and resolved instances. Out: diagnostics about what one process cannot have, the settings
of the processes, and connections with the middleware `inproc`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check.codes import groups as codes
from robocomp_dsl.check.ddsl.carriers import required_qos
from robocomp_dsl.check.ddsl.readiness import limits_of
from robocomp_dsl.check.ddsl.restarts import ready_of, restart_of
from robocomp_dsl.check.ddsl.scopes import DeploymentScope
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import (
    START_TIMEOUT_S,
    Connection,
    External,
    Group,
    Instance,
    OwnPort,
)
from robocomp_dsl.model.port_middlewares import IN_PROCESS
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Node

_PYTHON = "python"


def process_of(scope: DeploymentScope) -> DeploymentScope | None:
    """The outermost group with `inprocess` around a scope: its components share that process."""
    found = None
    for nested in scope.ancestors:
        if isinstance(nested.tree, ast.Group) and nested.tree.inprocess:
            found = nested
    return found


def processes_of_instances(scope: DeploymentScope) -> dict[str, str]:
    """The paths of the processes of groups, by qualified names of the instances in them."""
    found: dict[str, str] = {}
    for nested in scope.descendants:
        process = process_of(nested)
        if process is not None:
            found |= dict.fromkeys(map(nested.qualified_name, nested.instances), process.path)
    return found


def with_process(
    group: Group, scope: DeploymentScope, members: Sequence[Instance], report: Report
) -> Group:
    """The group with the settings of its process, if it has one of its own."""
    tree = scope.tree
    if not isinstance(tree, ast.Group):
        return group
    if process_of(scope) is not scope:
        for what, node in _process_settings(tree):
            report.add(
                codes.PROCESS_SETTING,
                node.span,
                f"`{what}` is of a process, and `{scope.tree.name.text}` is not one",
                help="add `inprocess;`, or write it in each component",
            )
        return group
    longest = max((member.start_timeout_s for member in members), default=START_TIMEOUT_S)
    return group.replace(
        inprocess=True,
        restart=restart_of(tree.restart, report),
        start_timeout_s=ready_of(tree.ready, report) if tree.ready else longest,
        limits=limits_of(tree, report),
    )


def _process_settings(tree: ast.Group) -> Iterator[tuple[str, Node]]:
    named: dict[str, Node | None] = {"memory": tree.memory, "cpu": tree.cpu}
    named["restart"] = tree.restart
    named["cores"] = tree.cores[0] if tree.cores else None
    named["realtime priority"] = tree.realtime
    named["ready within"] = tree.ready
    yield from ((what, node) for what, node in named.items() if node is not None)


def check_processes(scope: DeploymentScope, known: Mapping[str, Instance], report: Report) -> None:
    """Report what the components of one process cannot have."""
    for process in scope.descendants:
        if process_of(process) is not process:
            continue
        members = []
        for nested in process.descendants:
            for name, tree in nested.instances.items():
                _check_member(tree, process, report)
                if (instance := known.get(nested.qualified_name(name))) is not None:
                    members.append((tree, instance))
        _check_languages(members, process, report)
        _check_hosts(members, process, report)
        _check_environment(members, process, report)
        _check_devices(members, process, report)


def _check_member(tree: ast.Instance, process: DeploymentScope, report: Report) -> None:
    group = process.tree.name.text
    if tree.is_program:
        report.add(
            codes.ONE_PROCESS,
            tree.name.span,
            f"`{tree.name.text}` is a program: it cannot run in the process of `{group}`",
            help="move it out of the group",
        )
        return
    if tree.executable:
        report.add(
            codes.ONE_PROCESS,
            tree.executable.span,
            f"`{tree.name.text}` has a command line of its own, but runs in the process of"
            f" `{group}`",
            help="remove `executable`, or move the component out of the group",
        )
    settings: dict[str, Node | None] = {
        "memory": tree.memory,
        "cpu": tree.cpu,
        "cores": tree.cores[0] if tree.cores else None,
        "realtime priority": tree.realtime,
        "restart": tree.restart,
        "ready when": tree.ready_when,
    }
    for what, node in settings.items():
        if node is not None:
            where = "remove it" if what == "ready when" else f"write it in `group {group}`"
            report.add(
                codes.ONE_PROCESS,
                node.span,
                f"`{what}` is of a process, and `{tree.name.text}` runs in that of `{group}`",
                help=where,
            )


_Members = Sequence[tuple[ast.Instance, Instance]]


def _check_languages(members: _Members, process: DeploymentScope, report: Report) -> None:
    for tree, instance in members:
        language = instance.component.language
        if not tree.is_program and language and language.lower() != _PYTHON:
            report.add(
                codes.ONE_PROCESS,
                tree.name.span,
                f"`{instance.component.name}` is written in {language}: it cannot run in the"
                f" process of `{process.tree.name.text}`",
                help="move it out of the group",
            )


def _check_hosts(members: _Members, process: DeploymentScope, report: Report) -> None:
    components = [(tree, instance) for tree, instance in members if not tree.is_program]
    for tree, instance in components[1:]:
        first_tree, first = components[0]
        if _place_of(instance) != _place_of(first):
            report.add(
                codes.ONE_PROCESS,
                (tree.host or tree.name).span,
                f"`{instance.name}` and `{first.name}` are on different hosts, but run in the"
                f" process of `{process.tree.name.text}`",
                notes=[Note((first_tree.host or first_tree.name).span, f"`{first.name}` is here")],
                help=f"write the host at the group: `group {process.tree.name.text} on HOST`",
            )


def _place_of(instance: Instance) -> tuple[str, str]:
    """What is equal for components that run on the same host."""
    return instance.host.name, instance.placement.unit


def _check_environment(members: _Members, process: DeploymentScope, report: Report) -> None:
    first: dict[str, tuple[ast.Environment, str]] = {}
    for tree, instance in members:
        for node in tree.environment:
            earlier, name = first.setdefault(node.name.text, (node, instance.name))
            if earlier.value.value != node.value.value:
                report.add(
                    codes.ENVIRONMENT_CONFLICT,
                    node.value.span,
                    f"`{instance.name}` and `{name}` need different values of"
                    f" `{node.name.text}`, but run in the process of `{process.tree.name.text}`",
                    notes=[Note(earlier.value.span, "the other value is here")],
                    help="give both the same value, or move one of them out of the group",
                )


def _check_devices(members: _Members, process: DeploymentScope, report: Report) -> None:
    with_devices = [(tree, instance) for tree, instance in members if instance.devices]
    for tree, instance in with_devices[1:]:
        report.add(
            codes.ONE_PROCESS,
            tree.name.span,
            f"`{instance.name}` and `{with_devices[0][1].name}` both have devices, but run in the"
            f" process of `{process.tree.name.text}`",
            help="move one of them out of the group",
        )


def within_processes(
    connections: Sequence[Connection], known: KnownMiddlewares
) -> tuple[Connection, ...]:
    """The connections; those within a process are plain calls unless they name a middleware."""
    description = known.describe(IN_PROCESS)
    able = description.capabilities.qos if description else frozenset()
    return tuple(
        connection.replace(middleware=IN_PROCESS)
        if is_within_process(connection)
        and not connection.middleware
        and not _chooses_middleware(connection)
        and all(
            item in able
            for item in required_qos(connection.qos, is_topic=connection.source_port.role.is_topic)
        )
        else connection
        for connection in connections
    )


def is_within_process(connection: Connection) -> bool:
    """Whether both ends of a connection are components of one process."""
    source, target = connection.source, connection.target
    external = isinstance(source, External) or isinstance(target, External)
    same_process = bool(source.process) and source.process == target.process
    return same_process and not external and _place_of(source) == _place_of(target)


def _chooses_middleware(connection: Connection) -> bool:
    """Whether the deployment chooses the middleware of one of the ports."""

    def chosen(own_ports: Sequence[OwnPort], port: str) -> bool:
        return any(own.port == port for own in own_ports)

    return chosen(connection.source.own_ports, connection.source_port.name) or chosen(
        connection.target.own_ports, connection.target_port.name
    )

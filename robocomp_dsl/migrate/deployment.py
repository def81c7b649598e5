"""Draft a deployment from the addresses and processes of the old components.

In: the migrated components, and the processes of a manager's file if there is one. Out: a
`DeploymentDraft`: instances, connections, and stand-ins for components known only by address.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes, worker_codes
from robocomp_dsl.migrate.connections import connect_instance
from robocomp_dsl.migrate.instances import (
    COMMON_BEHAVIOR,
    DeploymentDraft,
    InstanceNames,
    MigratedInstance,
    host_name,
)
from robocomp_dsl.migrate.manager import ManagerNode
from robocomp_dsl.migrate.migrated_component import MigratedComponent, MigratedConfig
from robocomp_dsl.model.interface import Interface

FIRST_PORT, LAST_PORT = 1024, 65535


def draft_deployment(
    moved: Sequence[MigratedComponent], nodes: Sequence[ManagerNode], report: Report
) -> DeploymentDraft:
    """The deployment of the manager's processes; without a manager, one instance per component."""
    names = InstanceNames(component.name for component in moved)
    if nodes:
        instances = [_instance_of_node(node, names, moved, report) for node in nodes]
        _set_start_order(instances, nodes, report)
    else:
        instances = [
            _instance_of_component(component, names.claim(component.name))
            for component in moved
            if component.component
        ]
    draft = DeploymentDraft(instances)
    for instance in list(instances):
        connect_instance(instance, draft, names, report)
    _assign_ports(draft.instances)
    if draft.instances and not any(instance.migrated for instance in draft.instances):
        message = "all components of the deployment are stand-ins: no folder of a component fits"
        fix = "name the folders of the components in the same run"
        report.add(worker_codes.ONLY_STAND_INS, nodes[0].span.source.file_span, message, help=fix)
    return draft


def _instance_of_component(moved: MigratedComponent, name: str) -> MigratedInstance:
    config = moved.configs[0] if moved.configs else None
    instance = MigratedInstance(name, moved.span, moved, config)
    instance.endpoints = list(config.ice.endpoints) if config else []
    return instance


def _instance_of_node(
    node: ManagerNode, names: InstanceNames, moved: Sequence[MigratedComponent], report: Report
) -> MigratedInstance:
    migrated = _component_of(node, moved)
    name = names.claim(node.name) if migrated else names.claim_stand_in(node.name)
    instance = MigratedInstance(name, node.span, migrated, host=node.host, user=node.user)
    if node.address is not None:
        instance.endpoints.append(node.address)
    if instance.migrated is not None:
        instance.config = _config_of(node, instance.migrated, report)
        instance.endpoints += instance.config.ice.endpoints if instance.config else ()
    if node.command:
        message = f"`{node.name}` was started with `{node.command:.200}`"
        report.add(codes.UNUSED_COMMAND, node.span, message)
        instance.comments.append(f"was started with: {node.command}")
    return instance


def candidate_names(node: ManagerNode) -> tuple[set[str], ...]:
    """Possible names of a process's component, in lower case; the most reliable first."""
    words = [re.split(r"[/\\]", word)[-1] for word in node.command.split()]
    programs = {re.sub(r"\.py$", "", word).lower() for word in words}
    return {node.folder.name.lower()}, programs, {node.name.lower()}


def _component_of(
    node: ManagerNode, moved: Sequence[MigratedComponent]
) -> MigratedComponent | None:
    """The component of a process, by its folder, its program or its name, in this order."""
    for names in candidate_names(node):
        for component in moved:
            if names & {component.folder.name.lower(), component.name.lower()}:
                return component
    return None


def _config_of(
    node: ManagerNode, moved: MigratedComponent, report: Report
) -> MigratedConfig | None:
    if node.config is None:
        return moved.configs[0] if moved.configs else None
    for config in moved.configs:
        if config.old.name == node.config.name:
            return config
    message = (
        f"`{node.name}` had the configuration `{node.config}`, which {moved.name} does not have"
    )
    report.add(codes.MANAGER_SETTING, node.span, message)
    return moved.configs[0] if moved.configs else None


def _set_start_order(
    instances: Sequence[MigratedInstance], nodes: Sequence[ManagerNode], report: Report
) -> None:
    """Fill `after`; unknown names and dependencies that close a cycle are left out."""
    by_name = {node.name: instance for node, instance in zip(nodes, instances, strict=True)}
    for node, instance in zip(nodes, instances, strict=True):
        for name, span in node.after:
            other = by_name.get(name)
            if other is None:
                message = f"`{node.name}` depends on `{name}`, which is not in the deployment"
                report.add(codes.DEPENDENCE_DROPPED, span, message)
            elif instance.name in _dependencies(other, instances):
                message = f"`{node.name}` depends on `{name}`, which waits for `{node.name}` itself"
                report.add(codes.DEPENDENCE_DROPPED, span, message)
            elif other.name not in instance.after:
                instance.after.append(other.name)


def _dependencies(instance: MigratedInstance, instances: Sequence[MigratedInstance]) -> set[str]:
    """The names of `instance` and of everything that it depends on."""
    by_name = {other.name: other for other in instances}
    names, pending = {instance.name}, [instance]
    while pending:
        for name in pending.pop().after:
            if name not in names:
                names.add(name)
                pending.append(by_name[name])
    return names


def _assign_ports(instances: Sequence[MigratedInstance]) -> None:
    """Set the TCP port of each instance: the first of its endpoints that is free on its host."""
    taken: set[tuple[str, int]] = set()
    for instance in instances:
        listed = [a for a in instance.endpoints if not a.name.lower().endswith(COMMON_BEHAVIOR)]
        listed = [a for a in listed if not a.identity.lower().endswith(COMMON_BEHAVIOR)]
        for address in listed:
            key = (host_name(instance.host), address.port)
            if FIRST_PORT <= address.port <= LAST_PORT and key not in taken and not instance.port:
                taken.add(key)
                instance.port = address.port
        rest = [a for a in listed if a.port and a.port != instance.port]
        words = (f"{a.port} for {a.name}" if a.name else str(a.port) for a in rest)
        instance.comments += [f"also listened on port {text}" for text in dict.fromkeys(words)]


def find_interface(name: str, interfaces: Iterator[Interface]) -> Interface | None:
    """The interface whose name is the Ice identity `name`, regardless of case."""
    return next((known for known in interfaces if known.name.lower() == name.lower()), None)


def join_path(path: str, below: str) -> str:
    """The path of a component's file, relative to the folder of the deployment."""
    return str(PurePosixPath(below) / path) if below else path

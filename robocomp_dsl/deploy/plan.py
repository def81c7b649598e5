"""Computes the processes of a deployment. Pure: reads, opens and starts nothing.

In: a resolved deployment, its running name and domain. Out: a `Plan`: for each component the
command line with its connections, the environment, and the start and stop order.
"""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from graphlib import TopologicalSorter
from pathlib import Path

from robocomp_dsl.deploy.connection_flags import connection_flags, middleware_flags, name_for
from robocomp_dsl.deploy.devices import describe_devices, devices_environment
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.group_processes import join_groups
from robocomp_dsl.deploy.plan_text import describe_clock, describe_host, describe_placement
from robocomp_dsl.deploy.planned_group import PlannedGroup, planned_groups
from robocomp_dsl.deploy.process import Process
from robocomp_dsl.model.connection_index import ConnectionIndex
from robocomp_dsl.model.deployment import (
    Clock,
    Connection,
    Deployment,
    External,
    ExternalConnection,
    Instance,
    Restart,
)
from robocomp_dsl.model.parameter import Default
from robocomp_dsl.model.port_middlewares import port_middlewares
from robocomp_dsl.runtime.time.clock_settings import LOCKSTEP, SIM, ClockSettings

__all__ = [
    "PYTHON_PROGRAMS",
    "Plan",
    "Process",
    "batches",
    "format_clock",
    "format_literal",
    "format_settings",
    "plan",
    "used_middlewares",
]

PYTHON_PROGRAMS = ("python3", "python")
"""Program names that stand for the interpreter that runs rcdeploy (it has the runtime)."""


@dataclass(frozen=True, slots=True)
class Plan:
    """The processes of a deployment, in an order that respects `after`.

    `middlewares` are those that its ports use; `clock` is a text such as `simulated, from body`.
    """

    name: str
    path: Path
    domain: str
    middlewares: tuple[str, ...]
    processes: tuple[Process, ...]
    clock: str = "wall"
    externals: tuple[ExternalProgram, ...] = ()
    external_connections: tuple[ExternalConnection, ...] = ()
    groups: tuple[PlannedGroup, ...] = ()

    @property
    def components(self) -> tuple[Process, ...]:
        """The process of each component, also of those in the process of their group."""
        return tuple(each for process in self.processes for each in process.members or (process,))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all processes, and of the components in each; log records have them."""
        return tuple(
            each.name for process in self.processes for each in (process, *process.members)
        )

    def shutdown_batches(self) -> list[list[str]]:
        """Names of processes to stop, batch after batch; those of one batch stop together."""
        return batches({p.name: set(p.stops_after) for p in self.processes})


def plan(deployment: Deployment, *, name: str, domain: str, interpreter: str) -> Plan:
    """The processes of `deployment`. `interpreter` replaces `python3` in command lines."""
    full = {instance.name: instance.full_name for instance in deployment.instances}
    order = {name: i for i, name in enumerate(full)}
    index = ConnectionIndex(deployment.connections)
    followers = _followers(deployment)
    components = [
        replace(
            _process(deployment, instance, domain, interpreter, index.at(instance)),
            after=tuple(full[name] for name in instance.after),
            stops_after=tuple(
                full[name]
                for name in _stops_after(
                    instance, followers[instance.name], index.at(instance), order
                )
            ),
        )
        for instance in deployment.instances
    ]
    return Plan(
        name,
        deployment.path,
        domain,
        used_middlewares(deployment),
        join_groups(deployment, components, interpreter),
        describe_clock(deployment.clock),
        tuple(_external(external, deployment) for external in deployment.externals),
        deployment.external_connections,
        planned_groups(deployment),
    )


def used_middlewares(deployment: Deployment) -> tuple[str, ...]:
    """The middlewares that the ports of a deployment use, in order of first use."""
    index = ConnectionIndex(deployment.connections)
    names = {
        name: None
        for instance in deployment.instances
        for port in instance.component.ports
        for name in port_middlewares(instance, port, index.at(instance), deployment.middleware)
    }
    return tuple(names)


def _external(external: External, deployment: Deployment) -> ExternalProgram:
    ends = [(c.source, c.target) for c in deployment.connections]
    users = [
        (source if target is external else target).full_name
        for source, target in ends
        if external in (source, target)
    ]
    return ExternalProgram(
        external.name,
        external.middleware,
        external.address,
        str(external.only_port.role),
        external.only_port.interface.qualified,
        tuple(dict.fromkeys(users)),
    )


def batches(predecessors: dict[str, set[str]]) -> list[list[str]]:
    """Topological order in batches: each name follows all its predecessors.

    Names within a batch keep the order of `predecessors`; names that are not keys are ignored.
    Raises `graphlib.CycleError`.
    """
    order = {name: i for i, name in enumerate(predecessors)}
    sorter = TopologicalSorter({n: names & order.keys() for n, names in predecessors.items()})
    sorter.prepare()
    result = []
    while sorter.is_active():
        batch = sorted(sorter.get_ready(), key=order.__getitem__)
        result.append(batch)
        sorter.done(*batch)
    return result


def format_settings(instance: Instance) -> tuple[str, ...]:
    """The `set` lines of an instance as `key=value`."""
    return tuple(f"{key}={format_literal(value)}" for key, value in instance.settings)


def format_literal(value: Default) -> str:
    """A value as it is written after `--set key=`."""
    if isinstance(value, tuple):
        from robocomp_dsl.runtime.parameters.value_list import format_list  # noqa: PLC0415 - seldom

        return format_list(value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def _process(
    deployment: Deployment,
    instance: Instance,
    domain: str,
    interpreter: str,
    connections: Sequence[Connection],
) -> Process:
    """The process of `instance`, which has the `connections`."""
    clock = deployment.clock
    stops_all = clock.stop_on_timeout and clock.source is instance
    return Process(
        name=instance.full_name,
        component="program" if instance.is_program else instance.component.name,
        argv=tuple(_command_line(deployment, instance, domain, interpreter, connections)),
        cwd=instance.component.path.parent,
        env=(
            *instance.environment,
            *devices_environment(instance.devices),
            *_watchdog_environment(instance),
        ),
        restart=Restart("never") if stops_all else instance.restart,
        start_timeout_s=instance.start_timeout_s,
        readiness=instance.readiness,
        limits=instance.limits,
        watchdog_s=_watchdog_s(instance),
        port=instance.port,
        config=instance.config,
        context=instance.context,
        config_name=instance.config_name,
        settings=format_settings(instance),
        host=describe_host(instance.host),
        placement=describe_placement(instance),
        group=instance.group,
        devices=describe_devices(instance.devices),
        is_program=instance.is_program,
    )


def _watchdog_s(instance: Instance) -> float:
    configured = instance.watchdog_s
    return instance.component.watchdog_s if configured is None else configured


def _watchdog_environment(instance: Instance) -> tuple[tuple[str, str], ...]:
    """How a program that speaks sd_notify(3) learns its watchdog interval."""
    if not (instance.is_program and instance.watchdog_s):
        return ()
    return (("WATCHDOG_USEC", str(round(instance.watchdog_s * 1e6))),)


def _command_line(
    deployment: Deployment,
    instance: Instance,
    domain: str,
    interpreter: str,
    connections: Sequence[Connection],
) -> list[str]:
    command = shlex.split(instance.executable)
    if command and command[0] in PYTHON_PROGRAMS:
        command[0] = interpreter
    if instance.is_program:
        return command
    argv = [*command, "--name", instance.name]
    argv += ["--prefix", instance.prefix] if instance.prefix else []
    argv += ["--domain", domain]
    argv += middleware_flags(deployment, instance, connections)
    argv += ["--log-format", "json"]
    argv += ["--config", str(instance.config)] if instance.config else []
    argv += ["--context", instance.context] if instance.context else []
    argv += ["--config-name", instance.config_name] if instance.config_name else []
    argv += [word for setting in format_settings(instance) for word in ("--set", setting)]
    argv += ["--listen-port", str(instance.port)] if instance.port else []
    argv += _watchdog_flags(instance)
    if deployment.clock.source:
        argv += ["--clock", format_clock(deployment.clock, instance, deployment.instances)]
    return argv + connection_flags(instance, connections)


def _watchdog_flags(instance: Instance) -> list[str]:
    return [] if instance.watchdog_s is None else ["--watchdog", f"{instance.watchdog_s:g}"]


def format_clock(clock: Clock, instance: Instance, instances: Sequence[Instance]) -> str:
    """The value of `--clock` for `instance`; only the clock source gets the list of members."""
    assert clock.source is not None  # noqa: S101 - a wall clock needs no flag
    others = [
        name_for(instance, other)
        for other in instances
        if other is not clock.source and not other.is_program
    ]
    settings = ClockSettings(
        LOCKSTEP if clock.lockstep else SIM,
        name_for(instance, clock.source),
        tuple(sorted(others)) if clock.lockstep and instance is clock.source else (),
        clock.limit_s,
        clock.stop_on_timeout,
    )
    return settings.as_text()


def _followers(deployment: Deployment) -> dict[str, list[str]]:
    """The instances that start after each instance."""
    followers: dict[str, list[str]] = {instance.name: [] for instance in deployment.instances}
    for instance in deployment.instances:
        for name in instance.after:
            if name in followers:
                followers[name].append(instance.name)
    return followers


def _stops_after(
    instance: Instance,
    followers: Sequence[str],
    connections: Sequence[Connection],
    order: Mapping[str, int],
) -> tuple[str, ...]:
    """The components that use `instance` and so stop before it: by `after`, or as later clients.

    If two components use each other, the order of the deployment decides; there is no cycle.
    """
    name = instance.name
    users = set(followers)
    for connection in connections:
        ends = (connection.source.name, connection.target.name)
        if ends[0] != ends[1] and all(end in order for end in ends):
            users.add(ends[1] if ends[0] == name else ends[0])
    return tuple(sorted((u for u in users if order[u] > order[name]), key=order.__getitem__))

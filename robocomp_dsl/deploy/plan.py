"""Computes the processes of a deployment. Pure: reads, opens and starts nothing.

In: a resolved deployment, its running name and domain. Out: a `Plan`: for each component the
command line with its connections, the environment, and the start and stop order.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from graphlib import TopologicalSorter
from pathlib import Path

from robocomp_dsl.deploy.devices import describe_devices, devices_environment
from robocomp_dsl.deploy.plan_text import describe_clock, describe_host
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import (
    START_TIMEOUT_S,
    Clock,
    Connection,
    Deployment,
    Instance,
    Qos,
    Readiness,
    ResourceLimits,
    Restart,
)
from robocomp_dsl.model.types import Literal
from robocomp_dsl.runtime.time.clock_settings import LOCKSTEP, SIM, ClockSettings

PYTHON_PROGRAMS = ("python3", "python")
"""Program names that stand for the interpreter that runs rcdeploy (it has the runtime)."""
PRIORITIES = ("background", "low", "normal", "high", "realtime")


@dataclass(frozen=True, slots=True)
class Process:
    """The process of one component.

    `name` is the full name, with the prefix. `env` is added to the environment of rcdeploy.
    `after`: components that must be ready before it starts; `stops_after`: components that must
    have exited before it is stopped. `config`, `context`, `config_name` and `settings`
    (`key=value`) are those in `argv`; `config` None: the component's default, or what it finds by
    `context` and `config_name`. `port` 0: any free port. `host` and `group` are as written in the
    description, empty for this machine and for no group; `devices` are text lines.
    """

    name: str
    component: str
    argv: tuple[str, ...]
    cwd: Path
    env: tuple[tuple[str, str], ...] = ()
    after: tuple[str, ...] = ()
    stops_after: tuple[str, ...] = ()
    restart: Restart = field(default_factory=Restart)
    start_timeout_s: float = START_TIMEOUT_S
    readiness: Readiness = field(default_factory=Readiness)
    limits: ResourceLimits = field(default_factory=ResourceLimits)
    port: int = 0
    config: Path | None = None
    context: str = ""
    config_name: str = ""
    settings: tuple[str, ...] = ()
    host: str = ""
    group: str = ""
    devices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Plan:
    """The processes of a deployment, in an order that respects `after`.

    `clock` is a text such as `simulated, from body`.
    """

    name: str
    path: Path
    domain: str
    middleware: str
    processes: tuple[Process, ...]
    clock: str = "wall"

    def shutdown_batches(self) -> list[list[str]]:
        """Names of processes to stop, batch after batch; those of one batch stop together."""
        return batches({p.name: set(p.stops_after) for p in self.processes})


def plan(deployment: Deployment, *, name: str, domain: str, interpreter: str) -> Plan:
    """The processes of `deployment`. `interpreter` replaces `python3` in command lines."""
    full = {instance.name: instance.full_name for instance in deployment.instances}
    order = {name: i for i, name in enumerate(full)}
    processes = tuple(
        replace(
            _process(deployment, instance, domain, interpreter),
            after=tuple(full[name] for name in instance.after),
            stops_after=tuple(full[n] for n in _stops_after(instance.name, deployment, order)),
        )
        for instance in deployment.instances
    )
    clock = describe_clock(deployment.clock)
    return Plan(name, deployment.path, domain, deployment.middleware, processes, clock)


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


def format_literal(value: Literal) -> str:
    """A value as it is written after `--set key=`."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _process(deployment: Deployment, instance: Instance, domain: str, interpreter: str) -> Process:
    clock = deployment.clock
    stops_all = clock.stop_on_timeout and clock.source is instance
    return Process(
        name=instance.full_name,
        component="program" if instance.is_program else instance.component.name,
        argv=tuple(_command_line(deployment, instance, domain, interpreter)),
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
        port=instance.port,
        config=instance.config,
        context=instance.context,
        config_name=instance.config_name,
        settings=format_settings(instance),
        host=describe_host(instance.host),
        group=instance.group,
        devices=describe_devices(instance.devices),
    )


def _watchdog_environment(instance: Instance) -> tuple[tuple[str, str], ...]:
    """How a program that speaks sd_notify(3) learns its watchdog interval."""
    if not (instance.is_program and instance.watchdog_s):
        return ()
    return (("WATCHDOG_USEC", str(round(instance.watchdog_s * 1e6))),)


def _command_line(
    deployment: Deployment, instance: Instance, domain: str, interpreter: str
) -> list[str]:
    command = shlex.split(instance.executable)
    if command and command[0] in PYTHON_PROGRAMS:
        command[0] = interpreter
    if instance.is_program:
        return command
    argv = [*command, "--name", instance.name]
    argv += ["--prefix", instance.prefix] if instance.prefix else []
    argv += ["--domain", domain]
    argv += ["--middleware", deployment.middleware, "--log-format", "json"]
    argv += ["--config", str(instance.config)] if instance.config else []
    argv += ["--context", instance.context] if instance.context else []
    argv += ["--config-name", instance.config_name] if instance.config_name else []
    argv += [word for setting in format_settings(instance) for word in ("--set", setting)]
    argv += ["--listen-port", str(instance.port)] if instance.port else []
    argv += _watchdog_flags(instance)
    if deployment.clock.source:
        argv += ["--clock", format_clock(deployment.clock, instance, deployment.instances)]
    return argv + _connection_flags(instance, deployment.connections)


def _watchdog_flags(instance: Instance) -> list[str]:
    return [] if instance.watchdog_s is None else ["--watchdog", f"{instance.watchdog_s:g}"]


def format_clock(clock: Clock, instance: Instance, instances: Sequence[Instance]) -> str:
    """The value of `--clock` for `instance`; only the clock source gets the list of members."""
    assert clock.source is not None  # noqa: S101 - a wall clock needs no flag
    others = [
        _name_for(instance, other)
        for other in instances
        if other is not clock.source and not other.is_program
    ]
    settings = ClockSettings(
        LOCKSTEP if clock.lockstep else SIM,
        _name_for(instance, clock.source),
        tuple(sorted(others)) if clock.lockstep and instance is clock.source else (),
        clock.limit_s,
        clock.stop_on_timeout,
    )
    return settings.as_text()


def _stops_after(name: str, deployment: Deployment, order: dict[str, int]) -> tuple[str, ...]:
    """The components that use `name` and so stop before it: by `after`, or as later clients.

    If two components use each other, the order of the deployment decides; there is no cycle.
    """
    users = {instance.name for instance in deployment.instances if name in instance.after}
    for connection in deployment.connections:
        ends = (connection.source.name, connection.target.name)
        if name in ends and ends[0] != ends[1]:
            users.add(ends[1] if ends[0] == name else ends[0])
    return tuple(sorted((u for u in users if order[u] > order[name]), key=order.__getitem__))


def _connection_flags(instance: Instance, connections: Sequence[Connection]) -> list[str]:
    """The `--connect` and `--qos` flags of one process, in the order of the description."""
    flags: list[str] = []
    qualities: dict[str, list[Qos]] = {}
    for link in connections:
        ends = ((link.source, link.source_port), (link.target, link.target_port))
        # The flag goes to the end that looks for the other: the client, the subscriber.
        if link.source_port.role.is_topic:
            (peer, peer_port), (own, own_port) = ends
        else:
            (own, own_port), (peer, peer_port) = ends
        if own is instance:
            argument = _peer_argument(instance, peer, peer_port)
            flags += ["--connect", f"{own_port.name}={argument}"]
        for end, port in ends:
            if end is instance and link.qos != Qos():
                qualities.setdefault(port.name, []).append(link.qos)
    for name, requested in qualities.items():
        flags += ["--qos", f"{name}={format_qos(merge_qos(requested))}"]
    return flags


def _name_for(instance: Instance, other: Instance) -> str:
    """The full name of `other` for the command line of `instance`, without its prefix added."""
    return f"/{other.full_name}" if instance.prefix else other.full_name


def _peer_argument(instance: Instance, peer: Instance, port: Port) -> str:
    """`component`, or `component.port` if the peer has several ports of that interface."""
    same_kind = [
        p for p in peer.component.ports if p.role is port.role and p.interface is port.interface
    ]
    name = _name_for(instance, peer)
    return name if len(same_kind) == 1 else f"{name}.{port.name}"


def merge_qos(qualities: Iterable[Qos]) -> Qos:
    """The quality of service that satisfies all of `qualities`."""
    merged = Qos()
    for qos in qualities:
        reliable = [q.reliable for q in (merged, qos) if q.reliable is not None]
        priorities = [q.priority for q in (merged, qos) if q.priority is not None]
        depths = [q.depth for q in (merged, qos) if q.depth is not None]
        deadlines = [q.deadline_ms for q in (merged, qos) if q.deadline_ms is not None]
        merged = Qos(
            reliable=any(reliable) if reliable else None,
            priority=max(priorities, key=_priority_rank, default=None),
            depth=max(depths, default=None),
            deadline_ms=min(deadlines, default=None),
        )
    return merged


def _priority_rank(priority: str) -> int:
    return PRIORITIES.index(priority) if priority in PRIORITIES else 0


def format_qos(qos: Qos) -> str:
    """The value of `--qos PORT=`: `best_effort,depth=1,deadline=40`; the deadline in ms."""
    items = []
    if qos.reliable is not None:
        items.append("reliable" if qos.reliable else "best_effort")
    if qos.depth is not None:
        items.append(f"depth={qos.depth}")
    if qos.priority is not None:
        items.append(f"priority={qos.priority}")
    if qos.deadline_ms is not None:
        items.append(f"deadline={qos.deadline_ms:g}")
    return ",".join(items)

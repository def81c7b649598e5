"""What a deployment means in processes. Pure: nothing is read, opened or started here.

In: a resolved deployment, its running name and domain. Out: a `Plan`: per component the command
line with its wiring, the environment, what it waits for and what must have stopped before it.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from robocomp_dsl.deploy.devices import devices_environment, devices_shown
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import (
    READY_S,
    Clock,
    Connection,
    Deployment,
    Host,
    Instance,
    Qos,
    Restart,
)
from robocomp_dsl.model.types import Literal
from robocomp_dsl.runtime.clock_settings import LOCKSTEP, SIM, ClockSettings

PYTHONS = ("python3", "python")
"""Program names that mean the interpreter that runs rcdeploy, which has the runtime installed."""
PRIORITIES = ("background", "low", "normal", "high", "realtime")


@dataclass(frozen=True, slots=True)
class Process:
    """One component as a process.

    `env` is added to the environment of rcdeploy. `after`: what must be ready before it starts;
    `stops_after`: what must have ended before it is asked to stop. `config` (None: the
    component's own, or what it finds by `context` and `searched`) and `settings` (`key=value`) are
    those in `argv`. `port` 0: any.
    `name` is the whole one, with the prefix. `host` and `group` are as written, empty for this
    machine and for none; `devices` for people.
    """

    name: str
    component: str
    argv: tuple[str, ...]
    cwd: Path
    env: tuple[tuple[str, str], ...] = ()
    after: tuple[str, ...] = ()
    stops_after: tuple[str, ...] = ()
    restart: Restart = field(default_factory=Restart)
    ready_within_s: float = READY_S
    port: int = 0
    config: Path | None = None
    context: str = ""
    searched: str = ""
    settings: tuple[str, ...] = ()
    host: str = ""
    group: str = ""
    devices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Plan:
    """A deployment as processes, in an order that respects `after`.

    `clock` is in words, as in `simulated, from body`.
    """

    name: str
    path: Path
    domain: str
    middleware: str
    processes: tuple[Process, ...]
    clock: str = "wall"

    def stop_waves(self) -> list[list[str]]:
        """Names to stop together, wave after wave."""
        return waves({p.name: set(p.stops_after) for p in self.processes})


def plan(deployment: Deployment, *, name: str, domain: str, interpreter: str) -> Plan:
    """The processes of `deployment`. `interpreter` stands for `python3` in command lines."""
    whole = {instance.name: instance.whole_name for instance in deployment.instances}
    order = {name: i for i, name in enumerate(whole)}
    processes = tuple(
        replace(
            _process(deployment, one, domain, interpreter),
            after=tuple(whole[name] for name in one.after),
            stops_after=tuple(whole[name] for name in _users(one.name, deployment, order)),
        )
        for one in deployment.instances
    )
    clock = _shown_clock(deployment.clock)
    return Plan(name, deployment.path, domain, deployment.middleware, processes, clock)


def waves(waits_for: dict[str, set[str]]) -> list[list[str]]:
    """Topological order in waves: each waits only for earlier ones. A cycle ends in one wave."""
    left = {name: others & waits_for.keys() for name, others in waits_for.items()}
    made = []
    while left:
        wave = [name for name, others in left.items() if not others & left.keys()] or list(left)
        made.append(wave)
        for name in wave:
            del left[name]
    return made


def settings_of(instance: Instance) -> tuple[str, ...]:
    """Its `set` lines as `key=value`."""
    return tuple(f"{key}={shown(value)}" for key, value in instance.settings)


def shown(value: Literal) -> str:
    """A value as one writes it behind `--set key=`."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _process(deployment: Deployment, one: Instance, domain: str, interpreter: str) -> Process:
    settings = settings_of(one)
    clock = deployment.clock
    command = shlex.split(one.executable)
    if command and command[0] in PYTHONS:
        command[0] = interpreter
    argv = [*command, "--name", one.name]
    argv += ["--prefix", one.prefix] if one.prefix else []
    argv += ["--domain", domain]
    argv += ["--middleware", deployment.middleware, "--log-format", "json"]
    argv += ["--config", str(one.config)] if one.config else []
    argv += ["--context", one.context] if one.context else []
    argv += ["--from", one.searched] if one.searched else []
    argv += [word for setting in settings for word in ("--set", setting)]
    argv += ["--listen-port", str(one.port)] if one.port else []
    argv += ["--clock", clock_text(clock, one, deployment.instances)] if clock.source else []
    argv += _wiring(one, deployment.connections)
    return Process(
        name=one.whole_name,
        component=one.component.name,
        argv=tuple(argv),
        cwd=one.component.path.parent,
        env=(*one.environment, *devices_environment(one.devices)),
        restart=Restart("never") if clock.stops_when_lost and clock.source is one else one.restart,
        ready_within_s=one.ready_within_s,
        port=one.port,
        config=one.config,
        context=one.context,
        searched=one.searched,
        settings=settings,
        host=_shown_host(one.host),
        group=one.group,
        devices=devices_shown(one.devices),
    )


def clock_text(clock: Clock, one: Instance, instances: Sequence[Instance]) -> str:
    """As `--clock` takes it; only the source is told who takes part."""
    assert clock.source is not None  # noqa: S101 - a wall clock needs no flag
    others = [_seen_by(one, each) for each in instances if each is not clock.source]
    said = ClockSettings(
        LOCKSTEP if clock.lockstep else SIM,
        _seen_by(one, clock.source),
        tuple(sorted(others)) if clock.lockstep and one is clock.source else (),
        clock.limit_s,
        clock.stops_when_lost,
    )
    return said.as_text()


def _shown_host(host: Host) -> str:
    """The name of a host and where it is; empty for this machine without a name."""
    same = host.address in ("", host.name) or not host.name
    return host.name if same else f"{host.name} ({host.address})"


def _shown_clock(clock: Clock) -> str:
    if clock.source is None:
        return "wall"
    said = f"simulated, from {clock.source.whole_name}"
    if not clock.lockstep:
        return said
    lost = "stops when one is lost" if clock.stops_when_lost else "goes on without one that is lost"
    return f"{said}, in lock-step: at most {clock.limit_s:g} s a step, {lost}"


def _users(name: str, deployment: Deployment, order: dict[str, int]) -> tuple[str, ...]:
    """Who uses `name` and so stops before it: by `after`, or as a client that is listed later.

    The order of the deployment decides between two that use each other, so there is no cycle.
    """
    users = {one.name for one in deployment.instances if name in one.after}
    for wire in deployment.connections:
        ends = (wire.source.name, wire.target.name)
        if name in ends and ends[0] != ends[1]:
            users.add(ends[1] if ends[0] == name else ends[0])
    return tuple(sorted((u for u in users if order[u] > order[name]), key=order.__getitem__))


def _wiring(one: Instance, connections: Sequence[Connection]) -> list[str]:
    """The `--connect` and `--qos` flags of one process, in order of writing."""
    flags: list[str] = []
    qualities: dict[str, list[Qos]] = {}
    for wire in connections:
        topic = wire.source_port.role.is_topic
        # A wire is told to the side that must find the other: the client, the subscriber.
        finder, found = ("target", "source") if topic else ("source", "target")
        if getattr(wire, finder) is one:
            port = getattr(wire, f"{finder}_port").name
            peer = getattr(wire, found)
            flags += ["--connect", f"{port}={_peer(one, peer, getattr(wire, f'{found}_port'))}"]
        for end, port in ((wire.source, wire.source_port), (wire.target, wire.target_port)):
            if end is one and wire.qos != Qos():
                qualities.setdefault(port.name, []).append(wire.qos)
    for name, wanted in qualities.items():
        flags += ["--qos", f"{name}={qos_text(strictest(wanted))}"]
    return flags


def _seen_by(one: Instance, other: Instance) -> str:
    """The whole name of `other` for the command line of `one`: its own prefix is not added."""
    return f"/{other.whole_name}" if one.prefix else other.whole_name


def _peer(one: Instance, instance: Instance, port: Port) -> str:
    """`component`, or `component.port` where it has that interface more than once."""
    rivals = [
        p for p in instance.component.ports if p.role is port.role and p.interface is port.interface
    ]
    name = _seen_by(one, instance)
    return name if len(rivals) == 1 else f"{name}.{port.name}"


def strictest(wanted: Iterable[Qos]) -> Qos:
    """One quality for a port with several wires: what satisfies all of them."""
    made = Qos()
    for one in wanted:
        reliable = [q.reliable for q in (made, one) if q.reliable is not None]
        priorities = [q.priority for q in (made, one) if q.priority is not None]
        depths = [q.depth for q in (made, one) if q.depth is not None]
        deadlines = [q.deadline_ms for q in (made, one) if q.deadline_ms is not None]
        made = Qos(
            reliable=any(reliable) if reliable else None,
            priority=max(priorities, key=_rank, default=None),
            depth=max(depths, default=None),
            deadline_ms=min(deadlines, default=None),
        )
    return made


def _rank(priority: str) -> int:
    return PRIORITIES.index(priority) if priority in PRIORITIES else 0


def qos_text(qos: Qos) -> str:
    """As `--qos PORT=` takes it: `best_effort,depth=1,deadline=40`; the deadline in ms."""
    said = []
    if qos.reliable is not None:
        said.append("reliable" if qos.reliable else "best_effort")
    if qos.depth is not None:
        said.append(f"depth={qos.depth}")
    if qos.priority is not None:
        said.append(f"priority={qos.priority}")
    if qos.deadline_ms is not None:
        said.append(f"deadline={qos.deadline_ms:g}")
    return ",".join(said)

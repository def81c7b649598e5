"""Deployments of DDSL, resolved: which components run where, with what, wired how."""

from __future__ import annotations

from ipaddress import ip_address
from pathlib import Path

from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.devices import Devices
from robocomp_dsl.model.types import Literal
from robocomp_dsl.record import Record, Value
from robocomp_dsl.source import Span

READY_S = 60.0
"""What a component has until it is ready where nothing is said: a busy machine starts slowly."""


class Qos(Value):
    """Quality of service of one connection; None where nothing was written."""

    reliable: bool | None = None
    priority: str | None = None
    depth: int | None = None
    deadline_ms: float | None = None


class Restart(Value):
    """When a process that ended is started again, and how often at most within a window."""

    policy: str = "on-failure"
    max: int = 5
    window_s: float = 60.0


THIS_MACHINE = "localhost"
"""The host that need not be declared."""


class Host(Record):
    """A machine. The one named "" is this machine."""

    name: str
    address: str
    user: str = ""
    labels: tuple[str, ...] = ()
    span: Span | None = None

    @property
    def is_here(self) -> bool:
        """Whether it is the machine on which the deployment is started."""
        if self.address == THIS_MACHINE:
            return True
        try:
            return ip_address(self.address).is_loopback
        except ValueError:
            return False


class Instance(Record):
    """One component of the deployment.

    Of one in a group, the groups' names stand before its own in `name`, with `-`, as in
    `arm-motor`; `group` is `arm`, and empty for one in none. `placed` is where its host is named.
    With a `prefix` others see it, and all its ports, under `whole_name`: `left/arm-motor`.
    `config` is None for the component's own `etc/config.yaml`, or for a file of the `context`, or
    called as `searched` says, that the component finds when it starts; `settings` are the `set`
    lines, the keys dotted; `executable` is a command line run in the component's folder; `port` 0:
    any.
    """

    name: str
    component: Component
    span: Span
    host: Host
    config: Path | None = None
    context: str = ""
    searched: str = ""
    prefix: str = ""
    settings: tuple[tuple[str, Literal], ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    devices: Devices = Devices()
    executable: str = "python3 main.py"
    port: int = 0
    after: tuple[str, ...] = ()
    restart: Restart = Restart()
    ready_within_s: float = READY_S
    doc: str = ""
    group: str = ""
    placed: Span | None = None

    @property
    def whole_name(self) -> str:
        """The name by which it runs."""
        return f"{self.prefix}/{self.name}" if self.prefix else self.name


class Connection(Record):
    """`client.port` uses what `server.port` serves, or `subscriber` hears what `publisher` says.

    For a service `source` requires and `target` implements; for a topic `source` publishes and
    `target` subscribes to. Implied wires are listed too, with `implied`.
    """

    source: Instance
    source_port: Port
    target: Instance
    target_port: Port
    span: Span
    qos: Qos = Qos()
    implied: bool = False


class Export(Record):
    """A port of an instance inside a group that is used from outside, under `name`."""

    name: str
    instance: Instance
    port: Port
    span: Span


class Group(Record):
    """Components that appear as one outside, where only the `exports` are seen.

    `name` is as in `Instance.group`, outer groups first: `arm-hand`; `instances` are their names,
    those of groups inside included.
    """

    name: str
    instances: tuple[str, ...]
    exports: tuple[Export, ...]
    span: Span
    doc: str = ""


class Clock(Record):
    """The time by which all components live; the default is that of the machine.

    `source` is the instance that makes it when `kind` is `sim`; None where there is none that
    could. In lock-step the components act one at a time; one that needs more than `limit_s` for a
    step is lost: the others go on, or with `stops_when_lost` the source fails.
    """

    kind: str = "wall"
    source: Instance | None = None
    lockstep: bool = False
    limit_s: float = 10.0
    stops_when_lost: bool = False
    span: Span | None = None


class Deployment(Record):
    """One DDSL file; instances in an order that respects `after`, outer groups first."""

    name: str
    path: Path
    span: Span
    middleware: str
    instances: tuple[Instance, ...]
    connections: tuple[Connection, ...]
    hosts: tuple[Host, ...] = ()
    doc: str = ""
    groups: tuple[Group, ...] = ()
    clock: Clock = Clock()

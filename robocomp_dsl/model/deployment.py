"""Deployments of DDSL, resolved: instances, hosts, settings and connections."""

from __future__ import annotations

from functools import lru_cache
from ipaddress import ip_address
from pathlib import Path

from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.devices import Devices
from robocomp_dsl.model.parameter import Default
from robocomp_dsl.model.placement import Placement
from robocomp_dsl.model.types import Literal
from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span

START_TIMEOUT_S = 60.0
"""Default time until a component must be ready [s]; a busy machine starts slowly."""


class Qos(ValueRecord):
    """Quality of service of one connection; None: not specified.

    `thread_priority` is that of the receiving thread, 1 to 99.
    """

    reliable: bool | None = None
    priority: str | None = None
    depth: int | None = None
    deadline_ms: float | None = None
    keep_all: bool | None = None
    latched: bool | None = None
    liveliness_ms: float | None = None
    thread_priority: int | None = None


class Monitor(ValueRecord):
    """A Python class that sees, changes or rejects what travels through a connection.

    `position` is `sender` or `receiver`; `on_failure` is `bypass` or `close`.
    """

    file: Path
    class_name: str
    arguments: tuple[tuple[str, Literal], ...] = ()
    position: str = "receiver"
    on_failure: str = "bypass"


class OwnPort(ValueRecord):
    """What a deployment chooses for a port of an instance; `address` "": any."""

    port: str
    middleware: str
    address: str = ""


class Restart(ValueRecord):
    """The restart policy of a process, with at most `max` restarts per window."""

    policy: str = "on-failure"
    max: int = 5
    window_s: float = 60.0


class Readiness(ValueRecord):
    """When a program without lifecycle is ready; at most one is set.

    `pattern`: a line of its output matches this regular expression; `port`: this TCP port of
    loopback accepts connections; `delay_s`: it has run so long. The default: its lifecycle, or
    `READY=1` of sd_notify(3).
    """

    pattern: str = ""
    port: int = 0
    delay_s: float = 0.0


class ResourceLimits(ValueRecord):
    """Limits of a process and its children; 0: none. `cpu` 1.0 is one core.

    `cores` are the numbers of the CPU cores on which it may run, in ascending order; empty: all.
    `realtime` is its priority under SCHED_FIFO, 1 to 99; 0: the normal scheduler.
    """

    memory_bytes: int = 0
    cpu: float = 0.0
    cores: tuple[int, ...] = ()
    realtime: int = 0


THIS_MACHINE = "localhost"
"""The implicitly declared host."""


class Host(Record):
    """A machine, or one user of it. The host with the name "" is this machine.

    `address` is a host name, an IP address or an alias of ssh, without brackets and port;
    `ssh_port` 0: that of ssh's configuration. `port` is the TCP port of its router, 0: a number
    that follows from the name of the deployment.
    """

    name: str
    address: str
    user: str = ""
    labels: tuple[str, ...] = ()
    span: Span | None = None
    port: int = 0
    ssh_port: int = 0

    @property
    def machine(self) -> str:
        """A name of its machine: "" for all hosts on this machine."""
        return "" if self.is_local else self.name

    @property
    def is_local(self) -> bool:
        """Whether the host is the machine on which the deployment is started.

        A loopback address with a port of ssh is another machine, behind a tunnel.
        """
        if self.ssh_port:
            return False
        return self.address == THIS_MACHINE or _is_loopback(self.address)


@lru_cache(maxsize=1000)
def _is_loopback(address: str) -> bool:
    """Whether a text is a loopback address."""
    try:
        return ip_address(address).is_loopback
    except ValueError:
        return False


HERE = Host("", "127.0.0.1")
"""The host of an instance of which the file says nothing: this machine."""

UNPLACED = Host("", "")
"""The host of an instance whose host is chosen when the deployment starts."""


class Instance(Record):
    """One component of the deployment.

    In a group, `name` is prefixed with the names of the groups: `arm-motor`; `group` is then `arm`,
    otherwise empty; `process` is the group with `inprocess` around it. `host` is `UNPLACED` until a
    host is chosen by `placement`; `host_span` is where the file says it. `files` are further files
    and folders that it needs. With a `prefix`, the name of the running component is `full_name`:
    `left/arm-motor`. `config` is None if the component uses its own `etc/config.yaml` or searches
    for a file of the `context` or for `config_name` when it starts; `settings` are the `set` lines
    with dotted keys, `setting_paths` the files and folders that they name, which are absolute in
    both; `executable` is a command line run in the component's folder; `port` 0: any free port;
    `watchdog_s` None: as in the component; `middleware` "": as in the component. `is_program`: a
    program that is no component; its `component` has no ports, and the path of the DDSL file.
    """

    name: str
    component: Component
    span: Span
    host: Host
    config: Path | None = None
    context: str = ""
    config_name: str = ""
    prefix: str = ""
    settings: tuple[tuple[str, Default], ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    devices: Devices = Devices()
    executable: str = "python3 main.py"
    port: int = 0
    after: tuple[str, ...] = ()
    restart: Restart = Restart()
    start_timeout_s: float = START_TIMEOUT_S
    readiness: Readiness = Readiness()
    limits: ResourceLimits = ResourceLimits()
    watchdog_s: float | None = None
    middleware: str = ""
    own_ports: tuple[OwnPort, ...] = ()
    doc: str = ""
    group: str = ""
    process: str = ""
    host_span: Span | None = None
    is_program: bool = False
    placement: Placement = Placement()
    files: tuple[Path, ...] = ()
    setting_paths: tuple[Path, ...] = ()

    @property
    def full_name(self) -> str:
        """The name of the running component."""
        return f"{self.prefix}/{self.name}" if self.prefix else self.name


class External(Instance):
    """A program outside of the deployment, with the one port of its `component`.

    Only its `middleware` understands the `address`, which is empty for a client.
    """

    address: str = ""

    @property
    def only_port(self) -> Port:
        """The port that it has."""
        return self.component.ports[0]


class Connection(Record):
    """A connection from client to server, or from publisher to subscriber.

    For a service `source` requires and `target` implements; for a topic `source` publishes and
    `target` subscribes. `implied`: the connection is not written in the file. `middleware` "": that
    of its ports. `condition`: the events under which an arbitrated connection delivers; empty: it
    is not arbitrated.
    """

    source: Instance
    source_port: Port
    target: Instance
    target_port: Port
    span: Span
    qos: Qos = Qos()
    implied: bool = False
    middleware: str = ""
    middleware_span: Span | None = None
    monitors: tuple[Monitor, ...] = ()
    condition: str = ""


class ExternalConnection(Record):
    """A connection between ports of two external programs, which rcdeploy makes and keeps.

    `source` and `target` are names of ports as the middleware knows them; `carrier` is how it
    carries the messages, "": its default.
    """

    middleware: str
    source: str
    target: str
    carrier: str
    span: Span


class Export(Record):
    """A port of an instance in a group that is visible outside as `name`."""

    name: str
    instance: Instance
    port: Port
    span: Span


class Group(Record):
    """A group of components; only its `exports` are visible outside.

    `name` is as in `Instance.group`, outer groups first: `arm-hand`; `instances` are the names of
    its instances, including those of nested groups. `definition` is the name of its definition, if
    it is an instance of one. `prefix` includes those of the groups around it. `inprocess`: it and
    all groups in it are one process, which `restart`, `start_timeout_s` and `limits` are about.
    """

    name: str
    instances: tuple[str, ...]
    exports: tuple[Export, ...]
    span: Span
    doc: str = ""
    definition: str = ""
    prefix: str = ""
    inprocess: bool = False
    restart: Restart = Restart()
    start_timeout_s: float = START_TIMEOUT_S
    limits: ResourceLimits = ResourceLimits()

    @property
    def full_name(self) -> str:
        """Its name with its prefix, which is that of its process."""
        return f"{self.prefix}/{self.name}" if self.prefix else self.name


class Clock(Record):
    """The clock of all components; the default is the wall clock.

    `source` is the clock source if `kind` is `sim`; None if there is none. In lock-step the
    components run one at a time; one that exceeds `limit_s` for a step times out: the others
    continue, or the deployment stops if `stop_on_timeout`.
    """

    kind: str = "wall"
    source: Instance | None = None
    lockstep: bool = False
    limit_s: float = 10.0
    stop_on_timeout: bool = False
    span: Span | None = None


class Deployment(Record):
    """One DDSL file; instances in an order that respects `after`, outer groups first.

    `middleware` "": each component has its own.
    """

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
    externals: tuple[External, ...] = ()
    external_connections: tuple[ExternalConnection, ...] = ()

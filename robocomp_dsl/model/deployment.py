"""Deployments of DDSL, resolved: which components run where, with what, wired how."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.types import Literal
from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True)
class Qos:
    """Quality of service of one connection; None where nothing was written."""

    reliable: bool | None = None
    priority: str | None = None
    depth: int | None = None
    deadline_ms: float | None = None


@dataclass(frozen=True, slots=True)
class Restart:
    """When a process that ended is started again, and how often at most within a window."""

    policy: str = "on-failure"
    max: int = 5
    window_s: float = 60.0


@dataclass(frozen=True, slots=True, eq=False)
class Host:
    """A machine. The one named "" is this machine."""

    name: str
    address: str
    user: str = ""
    labels: tuple[str, ...] = ()
    span: Span | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Instance:
    """One component of the deployment.

    `config` is None for the component's own `etc/config.yaml`; `settings` are the `set` lines, the
    keys dotted; `executable` is a command line run in the component's folder; `port` 0: any.
    """

    name: str
    component: Component
    span: Span
    host: Host
    config: Path | None = None
    settings: tuple[tuple[str, Literal], ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    executable: str = "python3 main.py"
    port: int = 0
    after: tuple[str, ...] = ()
    restart: Restart = field(default_factory=Restart)
    ready_within_s: float = 10.0
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Connection:
    """`client.port` uses what `server.port` serves, or `subscriber` hears what `publisher` says.

    For a service `source` requires and `target` implements; for a topic `source` publishes and
    `target` subscribes to. Implied wires are listed too, with `implied`.
    """

    source: Instance
    source_port: Port
    target: Instance
    target_port: Port
    span: Span
    qos: Qos = field(default_factory=Qos)
    implied: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Deployment:
    """One DDSL file; instances in an order that respects `after`."""

    name: str
    path: Path
    span: Span
    middleware: str
    instances: tuple[Instance, ...]
    connections: tuple[Connection, ...]
    hosts: tuple[Host, ...] = ()
    doc: str = ""

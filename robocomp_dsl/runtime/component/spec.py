"""Data of a component: constants that generated code contains and the runtime reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.proxy import Proxy
from robocomp_dsl.runtime.machine.spec import MachineSpec
from robocomp_dsl.runtime.parameters import Parameters


@dataclass(frozen=True, slots=True)
class ServedPort:
    """An interface that other components use; `methods` maps its operations to methods.

    `middlewares` are the marks of the CDSL file, in order of preference; empty: the component's.
    """

    name: str
    interface: Interface
    methods: Mapping[str, str] = field(default_factory=dict)
    middlewares: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CalledPort:
    """An interface that this component calls or publishes, through the proxy at `attribute`.

    `middlewares` are as in `ServedPort`.
    """

    name: str
    proxy: type[Proxy]
    attribute: str
    middlewares: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ComponentSpec:
    """One component. `period` in ms, 0: `compute` is not called; `threads` run at a time.

    `watchdog`: after so many seconds a callback that has not returned hangs; 0: no watchdog.
    `has_window`: the class of the worker is a window of Qt.
    `connections`, `addresses` and `qualities` are as after `--connect`, `--address` and `--qos`;
    the command line overrides them for each port.
    """

    name: str
    period: int = 100
    threads: int = 1
    middleware: str = "zenoh"
    implements: tuple[ServedPort, ...] = ()
    requires: tuple[CalledPort, ...] = ()
    publishes: tuple[CalledPort, ...] = ()
    subscribes: tuple[ServedPort, ...] = ()
    parameters: type[Parameters] = Parameters
    version: str = ""
    machine: MachineSpec | None = None
    watchdog: float = 0.0
    has_window: bool = False
    connections: tuple[str, ...] = ()
    addresses: tuple[str, ...] = ()
    qualities: tuple[str, ...] = ()

    @property
    def ports(self) -> tuple[ServedPort | CalledPort, ...]:
        """All ports."""
        return (*self.implements, *self.requires, *self.publishes, *self.subscribes)

    def role_of_peers(self, port: ServedPort | CalledPort) -> str:
        """The role of what the port is connected to: `server`, `subscriber` or `publisher`."""
        if port in self.requires:
            return "server"
        return "subscriber" if port in self.publishes else "publisher"

"""Components of CDSL, resolved."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path

from robocomp_dsl.model.interface import Interface, Module, Operation, Pattern
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span


class Role(StrEnum):
    """The role of a component for an interface."""

    IMPLEMENTS = "implements"
    REQUIRES = "requires"
    SUBSCRIBES = "subscribesTo"
    PUBLISHES = "publishes"

    @property
    def is_topic(self) -> bool:
        """Whether the role is publishing or subscribing."""
        return self in (Role.SUBSCRIBES, Role.PUBLISHES)


class Port(Record):
    """One use of an interface.

    `name` identifies the port in the component: the instance name (`requires Laser as front`), else
    the interface's name, with the suffix 1, 2, … for a repeated one. `middlewares`, in order of
    preference, are empty for that of the component. An `optional` port may have no peer.
    """

    role: Role
    interface: Interface
    name: str
    span: Span
    middlewares: tuple[str, ...] = ()
    optional: bool = False

    @property
    def operations(self) -> tuple[Operation, ...]:
        """The operations that the port has: of a topic those without outputs."""
        every = self.interface.operations
        if not self.role.is_topic:
            return every
        return tuple(o for o in every if o.as_topic() is not Pattern.QUERY)

    def pattern(self, operation: Operation) -> Pattern:
        """How `operation` travels through this port."""
        return operation.as_topic() if self.role.is_topic else operation.as_service()


class StateMachineRef(ValueRecord):
    """`statemachine "path"`; the path as written, resolved beside the CDSL file.

    `machine` is None if the file is missing or faulty.
    """

    path: Path
    span: Span
    machine: StateMachine | None = None


class Component(Record):
    """One CDSL file.

    `language` is as written (`Python`, `Cpp`, `Cpp11`) at `language_span`; `period` in ms, 0: no
    periodic calls; `threads` 1: serialised execution; `watchdog_s` 0: no watchdog. `modules` are
    the imported IDSL modules (direct imports). `middleware_span` None: the default middleware.
    `invalid_ports` are the names of ports that `ports` lacks: their errors are reported in this
    file, so other files say nothing about them.
    """

    name: str
    path: Path
    span: Span
    language: str
    modules: tuple[Module, ...]
    ports: tuple[Port, ...]
    parameters: ParameterSet | None = None
    statemachine: StateMachineRef | None = None
    middleware: str = "zenoh"
    period: int = 100
    threads: int = 1
    watchdog_s: float = 0.0
    gui: str = ""
    options: tuple[str, ...] = ()
    doc: str = ""
    language_span: Span | None = None
    middleware_span: Span | None = None
    invalid_ports: frozenset[str] = frozenset()

    def with_role(self, role: Role) -> tuple[Port, ...]:
        """The ports of one role, in order of writing."""
        return tuple(p for p in self.ports if p.role is role)

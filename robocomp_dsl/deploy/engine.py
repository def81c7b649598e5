"""What commands do with a running deployment, whatever runs its processes.

`SupervisorEngine` asks the supervisor of one machine; `HostEngine` asks systemd on several hosts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from robocomp_dsl.deploy.external_connection import ConnectionStatus
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.status import ProcessStatus, SimulatedTime


class EngineError(Exception):
    """The engine cannot do what was requested; the message says why."""


@dataclass(frozen=True, slots=True)
class DeploymentStatus:
    """The status of a deployment; `clock` is None without a simulated clock.

    `connections` are those between external programs, of which rcdeploy knows no state. `problems`
    are hosts that do not answer, one text each. `last_lines`: the end of the log of each component
    that failed, where the engine of several hosts has it.
    """

    rows: list[ProcessStatus]
    clock: SimulatedTime | None = None
    externals: Sequence[ExternalProgram] = ()
    connections: Sequence[ConnectionStatus] = ()
    problems: Sequence[str] = ()
    last_lines: Mapping[str, Sequence[str]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class StopResult:
    """How a deployment ended, with the exit code of the command."""

    code: int
    reason: str


class Engine(Protocol):
    """A running deployment. All methods but `components` raise `EngineError`."""

    @property
    def name(self) -> str:
        """Its name, unique for this user."""

    @property
    def path(self) -> str:
        """The absolute path of its DDSL file."""

    @property
    def domain(self) -> str:
        """The domain in which its components connect."""

    def summary(self) -> str:
        """What runs it, and since when, as text."""

    def as_dict(self) -> dict[str, Any]:
        """Its description, for JSON."""

    def components(self) -> list[str]:
        """The full names of its components and programs, and of groups that are one process."""

    def answering_components(self) -> list[str]:
        """The full names of its components, without the programs, which answer no calls."""

    def status(self) -> DeploymentStatus:
        """The status of all components."""

    def change(self, verb: str, names: Sequence[str], report: Callable[[str], object]) -> int:
        """`start`, `stop` or `restart` components and groups; without names: all.

        `report` gets lines of text meanwhile. The result is an exit code.
        """

    def stop(self, report: Callable[[str], object]) -> StopResult:
        """Stop all components in order, and the deployment."""

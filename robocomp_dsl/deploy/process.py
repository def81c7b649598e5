"""The description of one process of a deployment. Pure data."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.model.deployment import START_TIMEOUT_S, Readiness, ResourceLimits, Restart


@dataclass(frozen=True, slots=True)
class Process:
    """The process of one component.

    `name` is the full name, with the prefix. `env` is added to the environment of rcdeploy.
    `after`: components that must be ready before it starts; `stops_after`: components that must
    have exited before it is stopped. `config`, `context`, `config_name` and `settings`
    (`key=value`) are those in `argv`; `config` None: the component's default, or what it finds by
    `context` and `config_name`. `port` 0: any free port. `host` and `group` are as written in the
    description, empty for this machine and for no group; `placement` is a text such as `on label
    gpu (robot, desk)` while the host is not chosen yet; `devices` are text lines. `is_program`: it
    is no component. `watchdog_s`: a callback that takes longer hangs; 0: no limit. `members` are
    the components of a group in one process, each as it would be alone; their `after` names other
    members.
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
    watchdog_s: float = 0.0
    port: int = 0
    config: Path | None = None
    context: str = ""
    config_name: str = ""
    settings: tuple[str, ...] = ()
    host: str = ""
    placement: str = ""
    group: str = ""
    devices: tuple[str, ...] = ()
    is_program: bool = False
    members: tuple[Process, ...] = ()

    @property
    def member_names(self) -> tuple[str, ...]:
        """The full names of `members`."""
        return tuple(member.name for member in self.members)

"""Protocol through which a managed process reaches its supervisor."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.supervisor.child import ChildProcess
from robocomp_dsl.deploy.supervisor.process_start import ProcessStarter
from robocomp_dsl.deploy.supervisor.process_watch import WatchedProcess


class SupervisorContext(Protocol):
    """What a managed process needs from the supervisor."""

    token: str
    environment: dict[str, str]
    grace_s: float
    starter: ProcessStarter

    def log(self, text: str, level: str = "INFO") -> None:
        """Log a message of rcdeploy."""

    def emit(self, record: LogRecord) -> None:
        """Emit a log record of a component."""

    def changed(self) -> None:
        """A status has changed."""

    def on_started(self, managed: WatchedProcess, child: ChildProcess) -> None:
        """A process was started."""

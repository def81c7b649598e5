"""Commands and files for a host, as data."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ENVIRONMENT_SCRIPT = (
    ': "${XDG_RUNTIME_DIR:=/run/user/$(id -u)}";'
    ' : "${DBUS_SESSION_BUS_ADDRESS:=unix:path=$XDG_RUNTIME_DIR/bus}";'
    ' export XDG_RUNTIME_DIR DBUS_SESSION_BUS_ADDRESS; exec "$@"'
)
"""Sets what `systemctl --user` needs, where the login did not; POSIX sh."""
COMMAND_TIMEOUT_S = 30.0
CONNECT_SILENCE_S = 15.0
"""A host that does not answer a step of the login within this time is out of reach."""


@dataclass(frozen=True, slots=True)
class CommandResult:
    """How a command ended; `code` is 128 + N after signal N."""

    code: int
    stdout: bytes
    stderr: bytes

    @property
    def text(self) -> str:
        """The standard output as text, without the last line end."""
        return self.stdout.decode("utf-8", "replace").rstrip("\n")

    @property
    def error(self) -> str:
        """The standard error as text, without white space around it."""
        return self.stderr.decode("utf-8", "replace").strip()


@dataclass(frozen=True, slots=True)
class Upload:
    """A file for a host: the content or a local file, and the path there."""

    local: Path | bytes
    remote: str
    mode: int = 0o644

"""Connections to the hosts of a deployment. In: a host. Out: commands run and files copied there.

Paths on a host are relative to the user's home, or absolute. A connection is used by one event
loop; its methods may run concurrently.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Sequence
from importlib import import_module
from typing import Protocol

from robocomp_dsl.deploy.hosts.commands import (
    COMMAND_TIMEOUT_S,
    CONNECT_SILENCE_S,
    CommandResult,
    Upload,
)
from robocomp_dsl.model.deployment import Host

__all__ = ["CommandResult", "HostConnection", "HostProcess", "Upload", "connect"]


class HostProcess(Protocol):
    """A command that runs on a host, with its input and output."""

    async def write(self, data: bytes) -> None:
        """Write to its standard input. Raises `HostError` if it has ended."""

    async def readline(self) -> bytes:
        """The next line of its standard output; empty at its end."""

    async def close(self) -> CommandResult:
        """Close its input, and wait for its end; `stdout` is what was not read."""


class HostConnection(Protocol):
    """An open connection to a host. Every method raises `HostError`."""

    host: Host

    async def run(
        self, command: Sequence[str], *, input: bytes = b"", timeout_s: float = COMMAND_TIMEOUT_S
    ) -> CommandResult:
        """Run a command in the user's home, without a shell's expansions."""

    async def start(self, command: Sequence[str]) -> HostProcess:
        """Start a command that is written to while it runs."""

    def stream(self, command: Sequence[str]) -> AsyncIterator[bytes]:
        """The standard output of a command in chunks, until it ends. At most four at a time."""

    async def read(self, path: str) -> bytes | None:
        """The content of a file; None if it does not exist."""

    async def write(self, path: str, data: bytes, mode: int = 0o644) -> None:
        """Replace a file at once; its folders are created."""

    async def upload(self, files: Sequence[Upload]) -> None:
        """Write files, each at once; their folders are created."""

    async def close(self) -> None:
        """End the connection; running commands of it end or lose their output."""


async def connect(host: Host, silence_s: float = CONNECT_SILENCE_S) -> HostConnection:
    """Connect to a host. Raises `HostUnreachable` or `HostRefused`.

    `silence_s`: how long to wait for the answer to each step of the login, in seconds.
    """
    if host.is_local:
        from robocomp_dsl.deploy.hosts.local import LocalConnection  # noqa: PLC0415

        return LocalConnection(host)
    load_ssh()
    from robocomp_dsl.deploy.hosts.ssh import connect_ssh  # noqa: PLC0415

    return await connect_ssh(host, silence_s)


def load_ssh() -> None:
    """Load asyncssh now, which takes 0.1 s. Raises `MissingExtra` if it is not installed."""
    import_module("robocomp_dsl.deploy.hosts.ssh_client")

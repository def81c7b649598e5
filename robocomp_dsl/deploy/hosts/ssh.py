"""A host over OpenSSH: commands in sessions, files by SFTP, all over one connection."""

from __future__ import annotations

import asyncio
import contextlib
import shlex
from collections.abc import AsyncIterator, Sequence

import asyncssh

from robocomp_dsl.deploy.hosts.address import describe_host
from robocomp_dsl.deploy.hosts.commands import (
    COMMAND_TIMEOUT_S,
    ENVIRONMENT_SCRIPT,
    CommandResult,
    Upload,
)
from robocomp_dsl.deploy.hosts.error_tail import ErrorTail
from robocomp_dsl.deploy.hosts.errors import (
    HostError,
    HostTimeout,
    HostUnreachable,
)
from robocomp_dsl.deploy.hosts.ssh_client import HostKeyCheck, describe_loss, open_connection
from robocomp_dsl.deploy.hosts.ssh_files import SshFiles
from robocomp_dsl.model.deployment import Host

CHUNK_BYTES = 65536
MAX_COMMANDS = 5
"""Commands at a time; sshd accepts 10 sessions over one connection, and SFTP needs another."""
CLOSE_TIMEOUT_S = 1.0


async def connect_ssh(host: Host, silence_s: float) -> SshConnection:
    """Connect to a host by SSH. Raises `HostUnreachable` or `HostRefused`."""
    check = HostKeyCheck()
    return SshConnection(host, await open_connection(host, check, silence_s), check)


def quote_command(command: Sequence[str]) -> str:
    """The command line for the login shell of the user, whatever shell that is."""
    return shlex.join(("/bin/sh", "-c", ENVIRONMENT_SCRIPT, "sh", *command))


class SshProcess:
    """A command that runs on a host, with its input and output."""

    def __init__(self, process: asyncssh.SSHClientProcess[bytes], owner: SshConnection) -> None:
        self._process = process
        self._owner = owner
        self._errors = ErrorTail(process.stderr.read)

    async def write(self, data: bytes) -> None:
        """Write to its standard input."""
        try:
            self._process.stdin.write(data)
            await self._process.stdin.drain()
        except (OSError, asyncssh.Error) as error:
            raise self._owner.describe_loss(error) from None

    async def readline(self) -> bytes:
        """The next line of its standard output; empty at its end."""
        parts: list[bytes] = []
        try:
            # asyncssh returns a part of a line that is longer than its buffer.
            while part := await self._process.stdout.readline():
                parts.append(part)
                if part.endswith(b"\n"):
                    break
        except (OSError, asyncssh.Error) as error:
            raise self._owner.describe_loss(error) from None
        if not parts:
            self._owner.check_open()
        return b"".join(parts)

    async def close(self) -> CommandResult:
        """Close its input, and wait for its end."""
        try:
            self._process.stdin.write_eof()
            stdout = await self._process.stdout.read()
            stderr = await self._errors.finish()
            await self._process.wait_closed()
        except (OSError, asyncssh.Error) as error:
            raise self._owner.describe_loss(error) from None
        finally:
            self._errors.cancel()
            self._process.close()
        return CommandResult(self._owner.exit_code(self._process), stdout, stderr)


class SshConnection:
    """A host, with the interface of `HostConnection`."""

    def __init__(
        self, host: Host, connection: asyncssh.SSHClientConnection, check: HostKeyCheck
    ) -> None:
        self.host = host
        self._connection = connection
        self._check = check
        self._commands = asyncio.Semaphore(MAX_COMMANDS)
        self._files = SshFiles(host, connection, check)

    # -------------------------------------------------------------- commands

    async def run(
        self, command: Sequence[str], *, input: bytes = b"", timeout_s: float = COMMAND_TIMEOUT_S
    ) -> CommandResult:
        """Run a command in the user's home."""
        async with self._commands:
            process = await self._create(command)
            try:
                async with asyncio.timeout(timeout_s):
                    return await self.wait_for(process, input)
            except TimeoutError:
                with contextlib.suppress(OSError, asyncssh.Error):
                    process.terminate()
                name = describe_host(self.host)
                text = f"{name}: `{command[0]}` did not end within {timeout_s:g} s"
                raise HostTimeout(text, "check the load of the host") from None
            finally:
                process.close()

    async def start(self, command: Sequence[str]) -> SshProcess:
        """Start a command that is written to while it runs."""
        return SshProcess(await self._create(command), self)

    async def stream(self, command: Sequence[str]) -> AsyncIterator[bytes]:
        """The standard output of a command in chunks, until it ends."""
        process = await self._create(command, stderr=asyncssh.DEVNULL)
        try:
            process.stdin.write_eof()
            while chunk := await process.stdout.read(CHUNK_BYTES):
                yield chunk
            self.check_open()
        except (OSError, asyncssh.Error) as error:
            raise self.describe_loss(error) from None
        finally:
            process.close()

    async def wait_for(
        self, process: asyncssh.SSHClientProcess[bytes], input: bytes = b""
    ) -> CommandResult:
        """Write the rest of the input, and read until the end."""
        try:
            if input:
                process.stdin.write(input)
            process.stdin.write_eof()
            stdout, stderr = await process.communicate()
        except (OSError, asyncssh.Error) as error:
            raise self.describe_loss(error) from None
        return CommandResult(self.exit_code(process), stdout or b"", stderr or b"")

    def exit_code(self, process: asyncssh.SSHClientProcess[bytes]) -> int:
        """How a command ended; raises `HostUnreachable` if that is not known."""
        if process.returncode is None:
            self.check_open()
            raise HostUnreachable(f"{describe_host(self.host)}: the command ended without a result")
        return process.returncode if process.returncode >= 0 else 128 - process.returncode

    async def _create(
        self, command: Sequence[str], stderr: int = asyncssh.PIPE
    ) -> asyncssh.SSHClientProcess[bytes]:
        try:
            return await self._connection.create_process(
                quote_command(command), encoding=None, stderr=stderr
            )
        except (OSError, asyncssh.Error) as error:
            raise self.describe_loss(error) from None

    # ----------------------------------------------------------------- files

    async def read(self, path: str) -> bytes | None:
        """The content of a file; None if it does not exist."""
        return await self._files.read(path)

    async def write(self, path: str, data: bytes, mode: int = 0o644) -> None:
        """Replace a file at once; its folders are created."""
        await self.upload([Upload(data, path, mode)])

    async def upload(self, files: Sequence[Upload]) -> None:
        """Write files, each at once; their folders are created."""
        await self._files.upload(files)

    # ------------------------------------------------------------------ life

    def describe_loss(self, error: Exception) -> HostError:
        """The error of an operation whose connection may have ended."""
        return describe_loss(self.host, self._check, error)

    def check_open(self) -> None:
        """Raise `HostUnreachable` if the connection has ended."""
        if self._check.lost is not None:
            raise self.describe_loss(self._check.lost)

    async def close(self) -> None:
        """End the connection."""
        self._connection.close()
        with contextlib.suppress(OSError, asyncssh.Error):
            try:
                async with asyncio.timeout(CLOSE_TIMEOUT_S):
                    await self._connection.wait_closed()
            except TimeoutError:  # the link is cut: what is not sent yet never will be
                self._connection.abort()

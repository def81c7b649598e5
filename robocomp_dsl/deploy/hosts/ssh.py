"""A host over OpenSSH: commands in sessions, files by SFTP, all over one connection."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import shlex
from collections.abc import AsyncIterator, Sequence
from pathlib import Path, PurePosixPath
from typing import cast

import asyncssh

from robocomp_dsl.deploy.hosts import codes
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
    HostRefused,
    HostTimeout,
    HostUnreachable,
    HostWriteError,
)
from robocomp_dsl.deploy.hosts.ssh_client import HostKeyCheck, open_connection
from robocomp_dsl.model.deployment import Host

CHUNK_BYTES = 65536
MAX_COMMANDS = 5
"""Commands at a time; sshd accepts 10 sessions over one connection, and SFTP needs another."""
MAX_UPLOADS = 16


async def connect_ssh(host: Host) -> SshConnection:
    """Connect to a host by SSH. Raises `HostUnreachable` or `HostRefused`."""
    check = HostKeyCheck()
    return SshConnection(host, await open_connection(host, check), check)


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
        self._uploads = asyncio.Semaphore(MAX_UPLOADS)
        self._sftp: asyncssh.SFTPClient | None = None
        self._sftp_lock = asyncio.Lock()
        self._folders: set[str] = set()

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
        sftp = await self._files()
        try:
            async with sftp.open(path, "rb") as file:
                return cast("bytes", await file.read())
        except (asyncssh.SFTPNoSuchFile, asyncssh.SFTPNoSuchPath):
            return None
        except (OSError, asyncssh.Error) as error:
            raise await self._file_error("read", path, error) from None

    async def write(self, path: str, data: bytes, mode: int = 0o644) -> None:
        """Replace a file at once; its folders are created."""
        await self.upload([Upload(data, path, mode)])

    async def upload(self, files: Sequence[Upload]) -> None:
        """Write files, each at once; their folders are created."""
        sftp = await self._files()
        try:
            async with asyncio.TaskGroup() as tasks:
                for file in files:
                    tasks.create_task(self._upload(sftp, file))
        except* HostError as errors:
            raise _first(errors) from None

    async def _upload(self, sftp: asyncssh.SFTPClient, file: Upload) -> None:
        async with self._uploads:
            draft = f"{file.remote}.{secrets.token_hex(4)}~"
            try:
                await self._make_folder(sftp, str(PurePosixPath(file.remote).parent))
                attributes = asyncssh.SFTPAttrs(permissions=file.mode)
                async with sftp.open(draft, "wb", attributes) as target:
                    if isinstance(file.local, Path):
                        await _copy(file.local, target)
                    else:
                        await target.write(file.local)
                    await target.setstat(attributes)  # the umask of the host changed it
                await sftp.posix_rename(draft, file.remote)
            except (OSError, asyncssh.Error) as error:
                described = await self._file_error("write", file.remote, error)
                with contextlib.suppress(OSError, asyncssh.Error):
                    await sftp.remove(draft)
                raise described from None

    async def _make_folder(self, sftp: asyncssh.SFTPClient, folder: str) -> None:
        if folder not in self._folders:
            await sftp.makedirs(folder, exist_ok=True)
            self._folders.add(folder)

    async def _files(self) -> asyncssh.SFTPClient:
        async with self._sftp_lock:
            if self._sftp is None:
                try:
                    self._sftp = await self._connection.start_sftp_client()
                except (OSError, asyncssh.Error) as error:
                    raise self._sftp_error(error) from None
            return self._sftp

    def _sftp_error(self, error: Exception) -> HostError:
        if self._check.lost or isinstance(error, asyncssh.ConnectionLost):
            return self.describe_loss(error)
        return HostRefused(
            f"{describe_host(self.host)}: its SSH server offers no SFTP",
            "add the line `Subsystem sftp internal-sftp` to /etc/ssh/sshd_config of the host, and "
            "let it read it: `systemctl reload ssh`",
            codes.SYSTEMD,
        )

    async def _file_error(self, verb: str, path: str, error: Exception) -> HostError:
        if self._check.lost or isinstance(error, asyncssh.ConnectionLost):
            return self.describe_loss(error)
        name = describe_host(self.host)
        if verb == "write" and await self._is_full(path):
            return HostWriteError(
                f"{name}: cannot write {path}: no space is left", "delete files on the host"
            )
        reason = getattr(error, "reason", "") or getattr(error, "strerror", "") or error
        return HostWriteError(f"{name}: cannot {verb} {path}: {reason}")

    async def _is_full(self, path: str) -> bool:
        if self._sftp is None:
            return False
        try:
            status = await self._sftp.statvfs(str(PurePosixPath(path).parent))
        except (OSError, asyncssh.Error):
            return False
        return status.bavail * status.frsize < CHUNK_BYTES or status.favail == 0

    # ------------------------------------------------------------------ life

    def describe_loss(self, error: Exception) -> HostError:
        """The error of an operation whose connection may have ended."""
        name = describe_host(self.host)
        if isinstance(error, asyncssh.ChannelOpenError) and "closed" not in error.reason:
            return HostRefused(f"{name}: the SSH server refuses a session: {error.reason}")
        reason = self._check.lost or error
        return HostUnreachable(f"{name}: the connection was lost: {reason}")

    def check_open(self) -> None:
        """Raise `HostUnreachable` if the connection has ended."""
        if self._check.lost is not None:
            raise self.describe_loss(self._check.lost)

    async def close(self) -> None:
        """End the connection."""
        self._connection.close()
        with contextlib.suppress(OSError, asyncssh.Error):
            await self._connection.wait_closed()


async def _copy(source: Path, target: asyncssh.SFTPClientFile) -> None:
    with source.open("rb") as file:
        while chunk := file.read(1 << 20):
            await target.write(chunk)


def _first(errors: BaseExceptionGroup[HostError]) -> HostError:
    """One error for the user; the others have the same cause."""
    error: BaseException = errors
    while isinstance(error, BaseExceptionGroup):
        error = error.exceptions[0]
    return error if isinstance(error, HostError) else HostError(str(error))

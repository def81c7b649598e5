"""The files of a host, by SFTP over an open connection."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import cast

import asyncssh

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.deploy.hosts.address import describe_host
from robocomp_dsl.deploy.hosts.commands import Upload
from robocomp_dsl.deploy.hosts.errors import HostError, HostRefused, HostWriteError
from robocomp_dsl.deploy.hosts.ssh_client import HostKeyCheck, describe_loss
from robocomp_dsl.model.deployment import Host

MAX_UPLOADS = 16
FULL_BYTES = 65536
"""With less space a disk counts as full."""


class SshFiles:
    """Reads and writes files; one SFTP session, opened when it is needed."""

    def __init__(
        self, host: Host, connection: asyncssh.SSHClientConnection, check: HostKeyCheck
    ) -> None:
        self._host = host
        self._connection = connection
        self._check = check
        self._uploads = asyncio.Semaphore(MAX_UPLOADS)
        self._sftp: asyncssh.SFTPClient | None = None
        self._opening = asyncio.Lock()
        self._folders: set[str] = set()  # created by this connection

    async def read(self, path: str) -> bytes | None:
        """The content of a file; None if it does not exist."""
        sftp = await self._open()
        try:
            async with sftp.open(path, "rb") as file:
                return cast("bytes", await file.read())
        except (asyncssh.SFTPNoSuchFile, asyncssh.SFTPNoSuchPath):
            return None
        except (OSError, asyncssh.Error) as error:
            raise await self._file_error("read", path, error) from None

    async def upload(self, files: Sequence[Upload]) -> None:
        """Write files, each at once; their folders are created."""
        sftp = await self._open()
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
                attributes = asyncssh.SFTPAttrs(permissions=file.mode)
                async with await self._create(sftp, draft, attributes) as target:
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

    async def _create(
        self, sftp: asyncssh.SFTPClient, path: str, attributes: asyncssh.SFTPAttrs
    ) -> asyncssh.SFTPClientFile:
        """Create a file, and its folder if there is none.

        Most folders exist, and each level of a path costs two round trips to create.
        """
        try:
            return await sftp.open(path, "wb", attributes)
        except (asyncssh.SFTPNoSuchFile, asyncssh.SFTPNoSuchPath):
            folder = str(PurePosixPath(path).parent)
            if folder in self._folders:
                raise
        await sftp.makedirs(folder, exist_ok=True)
        self._folders.add(folder)
        return await sftp.open(path, "wb", attributes)

    async def _open(self) -> asyncssh.SFTPClient:
        async with self._opening:
            if self._sftp is None:
                try:
                    self._sftp = await self._connection.start_sftp_client()
                except (OSError, asyncssh.Error) as error:
                    raise self._sftp_error(error) from None
            return self._sftp

    def _sftp_error(self, error: Exception) -> HostError:
        if self._check.lost or isinstance(error, asyncssh.ConnectionLost):
            return describe_loss(self._host, self._check, error)
        return HostRefused(
            f"{describe_host(self._host)}: its SSH server offers no SFTP",
            "add the line `Subsystem sftp internal-sftp` to /etc/ssh/sshd_config of the host, and "
            "let it read it: `systemctl reload ssh`",
            codes.SYSTEMD,
        )

    async def _file_error(self, verb: str, path: str, error: Exception) -> HostError:
        if self._check.lost or isinstance(error, asyncssh.ConnectionLost):
            return describe_loss(self._host, self._check, error)
        name = describe_host(self._host)
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
        return status.bavail * status.frsize < FULL_BYTES or status.favail == 0


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

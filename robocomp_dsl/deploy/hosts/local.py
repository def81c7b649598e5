"""The own machine as a host: the same operations by subprocesses and files."""

from __future__ import annotations

import asyncio
import contextlib
import os
import tempfile
from collections.abc import AsyncIterator, Sequence
from pathlib import Path

from robocomp_dsl.deploy.hosts.address import describe_host
from robocomp_dsl.deploy.hosts.commands import (
    COMMAND_TIMEOUT_S,
    ENVIRONMENT_SCRIPT,
    CommandResult,
    Upload,
)
from robocomp_dsl.deploy.hosts.error_tail import ErrorTail
from robocomp_dsl.deploy.hosts.errors import HostTimeout, HostUnreachable, HostWriteError
from robocomp_dsl.model.deployment import Host

CHUNK_BYTES = 65536
LINE_BYTES = 1 << 26
"""The longest line that can be read."""


class LocalProcess:
    """A command of this machine, with its input and output."""

    def __init__(self, process: asyncio.subprocess.Process, host: Host) -> None:
        self._process = process
        self._input, self._output = _pipes(process)
        self._host = host
        self._errors = ErrorTail(_errors_of(process).read)

    async def write(self, data: bytes) -> None:
        """Write to its standard input."""
        try:
            self._input.write(data)
            await self._input.drain()
        except OSError as error:
            text = f"{describe_host(self._host)}: the command has ended: {error}"
            raise HostUnreachable(text) from None

    async def readline(self) -> bytes:
        """The next line of its standard output; empty at its end."""
        return await self._output.readline()

    async def close(self) -> CommandResult:
        """Close its input, and wait for its end."""
        try:
            self._input.close()
            stdout = await self._output.read()
            stderr = await self._errors.finish()
            await self._process.wait()
        finally:
            self._errors.cancel()
            await _kill(self._process)
        return CommandResult(_exit_code(self._process), stdout, stderr)


class LocalConnection:
    """The own machine, with the interface of `HostConnection`."""

    def __init__(self, host: Host) -> None:
        self.host = host

    async def run(
        self, command: Sequence[str], *, input: bytes = b"", timeout_s: float = COMMAND_TIMEOUT_S
    ) -> CommandResult:
        """Run a command in the user's home."""
        process = await self._create(command)
        try:
            async with asyncio.timeout(timeout_s):
                stdout, stderr = await process.communicate(input)
        except TimeoutError:
            name = describe_host(self.host)
            text = f"{name}: `{command[0]}` did not end within {timeout_s:g} s"
            raise HostTimeout(text) from None
        finally:
            await _kill(process)
        return CommandResult(_exit_code(process), stdout, stderr)

    async def start(self, command: Sequence[str]) -> LocalProcess:
        """Start a command that is written to while it runs."""
        return LocalProcess(await self._create(command), self.host)

    async def stream(self, command: Sequence[str]) -> AsyncIterator[bytes]:
        """The standard output of a command in chunks, until it ends."""
        process = await self._create(command, stderr=asyncio.subprocess.DEVNULL)
        stdin, stdout = _pipes(process)
        stdin.close()
        try:
            while chunk := await stdout.read(CHUNK_BYTES):
                yield chunk
        finally:
            await _kill(process)

    async def read(self, path: str) -> bytes | None:
        """The content of a file; None if it does not exist."""
        try:
            return _absolute(path).read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise self._file_error("read", path, error) from None

    async def write(self, path: str, data: bytes, mode: int = 0o644) -> None:
        """Replace a file at once; its folders are created."""
        await self.upload([Upload(data, path, mode)])

    async def upload(self, files: Sequence[Upload]) -> None:
        """Write files, each at once; their folders are created."""
        for file in files:
            try:
                await asyncio.to_thread(_write, file)
            except OSError as error:
                raise self._file_error("write", file.remote, error) from None

    async def close(self) -> None:
        """Nothing is open."""

    async def _create(
        self, command: Sequence[str], stderr: int = asyncio.subprocess.PIPE
    ) -> asyncio.subprocess.Process:
        return await asyncio.create_subprocess_exec(
            *("/bin/sh", "-c", ENVIRONMENT_SCRIPT, "sh", *command),
            cwd=Path.home(),
            limit=LINE_BYTES,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=stderr,
        )

    def _file_error(self, verb: str, path: str, error: OSError) -> HostWriteError:
        reason = error.strerror or str(error)
        return HostWriteError(f"{describe_host(self.host)}: cannot {verb} {path}: {reason}")


def _pipes(
    process: asyncio.subprocess.Process,
) -> tuple[asyncio.StreamWriter, asyncio.StreamReader]:
    """The input and output of a process that was started with both."""
    if process.stdin is None or process.stdout is None:
        raise ValueError("the process has no pipes")
    return process.stdin, process.stdout


def _errors_of(process: asyncio.subprocess.Process) -> asyncio.StreamReader:
    """The standard error of a process that was started with it."""
    if process.stderr is None:
        raise ValueError("the process has no pipe for its errors")
    return process.stderr


def _absolute(path: str) -> Path:
    return Path.home() / path


def _write(file: Upload) -> None:
    path = _absolute(file.remote)
    path.parent.mkdir(parents=True, exist_ok=True)
    data = file.local if isinstance(file.local, bytes) else file.local.read_bytes()
    descriptor, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(data)
        os.chmod(temporary, file.mode)  # noqa: PTH101 - mkstemp gives a text
        os.replace(temporary, path)  # noqa: PTH105
    except OSError:
        Path(temporary).unlink(missing_ok=True)
        raise


def _exit_code(process: asyncio.subprocess.Process) -> int:
    code = process.returncode or 0
    return code if code >= 0 else 128 - code


async def _kill(process: asyncio.subprocess.Process) -> None:
    """End a command that still runs."""
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.wait()

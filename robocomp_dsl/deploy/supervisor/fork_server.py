"""Starts components by forking a process that has imported the runtime; others are executed.

In: processes of the plan. Out: the same process as after an exec, 0.2 s of CPU time earlier. What
is no plain `python3 PROGRAM` of this interpreter, or sets variables that an interpreter or library
reads when it is loaded, is executed, and so is everything if the server cannot run or has died.
"""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.process_start import ExecutedProcess, StartedProcess
from robocomp_dsl.runtime.component.supervisor_pipe import HEARTBEAT_VARIABLE
from robocomp_dsl.runtime.fork_server import messages

LOAD_VARIABLES = (
    *("PYTHON", "LD_", "LC_", "LANG", "MALLOC_", "GLIBC_", "OMP_", "OPENBLAS_", "GOTO_", "MKL_"),
    *("BLIS_", "NPY_", "NUMPY_", "ZENOH_", "RUST_"),
)
"""Variables with these prefixes have an effect when a program or library is loaded."""
_BUFFER_BYTES = 1 << 20


class ServerDied(Exception):
    """The fork server has exited."""


class ForkedProcess:
    """A child of the fork server."""

    def __init__(self, server: ForkServer, pid: int, stdout: int, stderr: int) -> None:
        self._server = server
        self.pid = pid
        self.stdout: IO[bytes] = os.fdopen(stdout, "rb")
        self.stderr: IO[bytes] = os.fdopen(stderr, "rb")

    async def exit_code(self) -> int:
        """See `StartedProcess`; that of a request to stop if nobody knows it any more."""
        with suppress(ServerDied):
            code = (await self._server.request({"reap": self.pid}, self.pid))["code"]
            if code is not None:
                return int(code)
        return -signal.SIGTERM


class ForkServer:
    """A `ProcessStarter`; its process starts when it is created, in a running event loop."""

    def __init__(self, token: Mapping[str, str], log: Callable[[str, str], None]) -> None:
        self._log = log
        self._loop = asyncio.get_running_loop()
        self._modules: set[str] = set()
        self._ready = asyncio.Event()
        self._is_alive = True
        self._starts = 0
        self._one_start = asyncio.Lock()
        self._replies: dict[int, asyncio.Future[dict[str, Any]]] = {}
        self._socket, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        for end in (self._socket, other):
            end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _BUFFER_BYTES)
        self._socket.setblocking(False)
        folder = Path(messages.__file__).parent
        with other:
            self._popen = subprocess.Popen(  # noqa: S603 - our own program
                [sys.executable, str(folder / "server.py"), str(other.fileno())],
                env={"PYTHONUNBUFFERED": "1", **os.environ, **token},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                pass_fds=(other.fileno(),),
                start_new_session=True,
            )
        self._loop.add_reader(self._socket.fileno(), self._receive)

    @property
    def pid(self) -> int:
        """The process of the server."""
        return self._popen.pid

    async def start(
        self, process: Process, environment: Mapping[str, str], heartbeat: int
    ) -> StartedProcess:
        """See `ProcessStarter`."""
        if is_forkable(process):
            await self._ready.wait()
            if self._is_alive and not shadowed_modules(process, self._modules):
                with suppress(ServerDied, BlockingIOError):
                    return await self._fork(process, environment, heartbeat)
        return ExecutedProcess(process, environment, heartbeat)

    async def _fork(
        self, process: Process, environment: Mapping[str, str], heartbeat: int
    ) -> StartedProcess:
        request = {
            "argv": list(process.argv),
            "cwd": str(process.cwd),
            "env": dict(environment),
            "heartbeat": HEARTBEAT_VARIABLE,
        }
        if len(messages.encode(request)) >= messages.MAX_BYTES - 64:
            return ExecutedProcess(process, environment, heartbeat)
        stdout, stderr = os.pipe(), os.pipe()
        try:
            async with self._one_start:
                self._starts += 1
                number = -self._starts  # no pid is negative
                descriptors = (stdout[1], stderr[1], heartbeat)
                reply = await self.request({"start": number, **request}, number, *descriptors)
        except BaseException:
            messages.close_all([stdout[0], stderr[0]])
            raise
        finally:
            messages.close_all([stdout[1], stderr[1]])
        if "errno" in reply:
            messages.close_all([stdout[0], stderr[0]])
            raise OSError(reply["errno"], os.strerror(reply["errno"]))
        return ForkedProcess(self, reply["pid"], stdout[0], stderr[0])

    async def request(
        self, request: dict[str, Any], number: int, *descriptors: int
    ) -> dict[str, Any]:
        """Send a request and wait for the reply. Raises `ServerDied` and `BlockingIOError`."""
        if not self._is_alive:
            raise ServerDied
        reply: asyncio.Future[dict[str, Any]] = self._loop.create_future()
        self._replies[number] = reply
        try:
            messages.send(self._socket, request, *descriptors)
            return await reply
        except BlockingIOError:
            raise
        except OSError:
            raise ServerDied from None
        finally:
            self._replies.pop(number, None)

    def close(self) -> None:
        """End the server; see `ProcessStarter`."""
        if self._is_alive:
            self._end()

    def _receive(self) -> None:
        try:
            received = messages.receive(self._socket)
        except BlockingIOError:
            return
        except (OSError, ValueError):
            received = None
        if received is None:
            was_ready = self._ready.is_set()
            self._end()
            if was_ready:
                self._log(
                    "the fork server died: the exit codes of running components are unknown, and "
                    "further starts take longer",
                    "WARNING",
                )
            return
        message, _ = received
        if "ready" in message:
            self._modules = set(message["modules"])
            self._ready.set()
            return
        reply = self._replies.get(message.get("started", message.get("reaped", 0)))
        if reply and not reply.done():
            reply.set_result(message)

    def _end(self) -> None:
        self._is_alive = False
        self._loop.remove_reader(self._socket.fileno())
        self._socket.close()
        self._popen.kill()
        self._popen.wait()
        self._ready.set()
        for reply in self._replies.values():
            if not reply.done():
                reply.set_exception(ServerDied())


def is_forkable(process: Process) -> bool:
    """Whether the process is a component that runs as `python3 PROGRAM …` of this interpreter."""
    argv = process.argv
    return (
        not process.is_program
        and len(argv) > 1
        and argv[0] == sys.executable
        and argv[1].endswith(".py")
        and (process.cwd / argv[1]).is_file()
        and not (process.limits.cores or process.limits.realtime)
        and not any(name.startswith(LOAD_VARIABLES) for name, _ in process.env)
    )


def shadowed_modules(process: Process, modules: set[str]) -> set[str]:
    """Modules that the program would find in its own folder, but which the server has imported."""
    folder = (process.cwd / process.argv[1]).resolve().parent
    names = {path.name.partition(".")[0] for path in folder.iterdir() if _is_module(path)}
    return names & modules - {"__main__"}


def _is_module(path: Path) -> bool:
    return path.suffix in (".py", ".so", ".pyc") or (path / "__init__.py").is_file()

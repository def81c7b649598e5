"""Control protocol of a running deployment: JSON lines over a Unix socket.

The server runs in the event loop of the supervisor and answers `status`, `logs`, `stop`, `start`
and `restart`. The client blocks and yields the replies. The reply to a `stop` of the whole
deployment is sent when all processes have exited. Requests about components have several replies:
`{"text": …}` lines, and at last `{"code": 0}`, or 1 if a component is not as requested.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import time
from collections import deque
from collections.abc import Awaitable, Callable, Iterator, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, TypeAlias

from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.external_connection import ConnectionStatus
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.status import ProcessStatus, SimulatedTime

JOURNAL_SIZE = 10_000
"""Records that `logs` can show from the past, and the queue length of each follower."""
REPLY_TIMEOUT_S = 0.5
"""rcdeploy answers within a millisecond; a stopped rcdeploy never."""
_CONNECT_PERIOD_S = 0.01
_STATUS = {"verb": "status"}
RecordFilter: TypeAlias = Callable[[LogRecord], bool]
RequestHandler: TypeAlias = Callable[
    [str, list[str], Callable[[str], Awaitable[None]]], Awaitable[bool]
]
"""Handles a verb with names of components; sends lines of text and returns its success."""


class LogJournal:
    """Ring buffer of the latest records, with followers that receive new records."""

    def __init__(self) -> None:
        self._records: deque[LogRecord] = deque(maxlen=JOURNAL_SIZE)
        self._followers: set[asyncio.Queue[LogRecord]] = set()
        self._count = 0

    def add(self, record: LogRecord) -> LogRecord:
        """Number `record`, store it and pass it to all followers; returns the numbered record."""
        self._count += 1
        record = replace(record, sequence=self._count)
        self._records.append(record)
        for queue in self._followers:
            if queue.full():
                queue.get_nowait()
            queue.put_nowait(record)
        return record

    def last(self, count: int, matches: RecordFilter) -> list[LogRecord]:
        """The latest `count` records that match, oldest first."""
        records = [record for record in self._records if matches(record)]
        return records[-count:] if count > 0 else []

    @contextlib.contextmanager
    def follow(self) -> Iterator[asyncio.Queue[LogRecord]]:
        """A queue that receives every new record."""
        queue: asyncio.Queue[LogRecord] = asyncio.Queue(JOURNAL_SIZE)
        self._followers.add(queue)
        try:
            yield queue
        finally:
            self._followers.discard(queue)


class ControlServer:
    """Answers requests of other terminals until `close`."""

    def __init__(
        self,
        journal: LogJournal,
        statuses: Callable[[], list[ProcessStatus]],
        stop: Callable[[str], None],
        time: Callable[[], SimulatedTime | None],
        handle_request: RequestHandler,
        externals: Callable[[], Sequence[ExternalProgram]],
        connections: Callable[[], Sequence[ConnectionStatus]] = tuple,
        programs: Sequence[str] = (),
    ) -> None:
        """`connections` are those between external programs; `programs` are no components."""
        self._journal = journal
        self._statuses = statuses
        self._stop = stop
        self._time = time
        self._handle_request = handle_request
        self._externals = externals
        self._external_connections = connections
        self._programs = list(programs)
        self._outcome: asyncio.Future[dict[str, Any]] | None = None
        self._connections: set[asyncio.Task[None]] = set()

    async def open(self, path: Path) -> None:
        """Listen at `path`. Only this user can access the folder."""
        self._outcome = asyncio.get_running_loop().create_future()
        with instances.shorten_socket_path(path) as name:
            self._server = await asyncio.start_unix_server(self._handle_connection, name)

    async def close(self, outcome: dict[str, Any]) -> None:
        """Send `outcome` to clients that wait for the end, and stop listening."""
        assert self._outcome is not None  # noqa: S101 - set by `open`
        self._outcome.set_result(outcome)
        self._server.close()
        if self._connections:
            await asyncio.wait(self._connections, timeout=1.0)

    async def _handle_connection(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        task = asyncio.current_task()
        assert task is not None  # noqa: S101 - this coroutine runs in a task
        self._connections.add(task)
        try:
            with contextlib.suppress(OSError, ValueError, asyncio.LimitOverrunError):
                request = json.loads(await reader.readline())
                # Other JSON values are not requests and get no reply.
                if isinstance(request, dict):
                    await self._answer(request, reader, writer)
        finally:
            writer.close()
            self._connections.discard(task)

    async def _answer(
        self, request: dict[str, Any], reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        match request.get("verb"):
            case "status":
                statuses, time = self._statuses(), self._time()
                answer = {
                    "rows": [process.as_dict() for process in statuses],
                    "clock": time.as_dict() if time else None,
                    "externals": [program.as_dict() for program in self._externals()],
                    "connections": [link.as_dict() for link in self._external_connections()],
                    "programs": self._programs,
                }
                await _send(writer, answer)
            case "logs":
                await self._logs(request, reader, writer)
            case "start" | "stop" | "restart" as verb if verb != "stop" or "components" in request:
                await self._change_components(verb, request.get("components"), writer)
            case "stop":
                self._stop("requested by `rcdeploy stop`")
                assert self._outcome is not None  # noqa: S101 - set by `open`
                await _send(writer, await asyncio.shield(self._outcome))

    async def _change_components(
        self, verb: str, names: object, writer: asyncio.StreamWriter
    ) -> None:
        """Handle a request about components; it is completed even if the client disconnects."""

        async def notify(text: str) -> None:
            with contextlib.suppress(OSError):
                await _send(writer, {"text": text})

        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            await notify("`components` must be a list of names")
            await _send(writer, {"code": 1})
            return
        succeeded = await self._handle_request(verb, names, notify)
        await _send(writer, {"code": 0 if succeeded else 1})

    async def _logs(
        self, request: dict[str, Any], reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        names, after = request.get("components"), int(request.get("after", 0))

        def matches(record: LogRecord) -> bool:
            return record.sequence > after and (not names or record.component in names)

        async def send(record: LogRecord) -> None:
            if matches(record):
                await _send(writer, asdict(record))

        with self._journal.follow() as queue:
            for record in self._journal.last(int(request.get("last", JOURNAL_SIZE)), matches):
                await send(record)
            if not request.get("follow"):
                return
            assert self._outcome is not None  # noqa: S101 - set by `open`
            disconnected = asyncio.ensure_future(reader.read())
            while not (disconnected.done() or self._outcome.done()):
                item = asyncio.ensure_future(queue.get())
                events: list[asyncio.Future[Any]] = [item, disconnected, self._outcome]
                await asyncio.wait(events, return_when=asyncio.FIRST_COMPLETED)
                if item.done():
                    await send(item.result())
                item.cancel()
            disconnected.cancel()
            while not queue.empty():
                await send(queue.get_nowait())


async def _send(writer: asyncio.StreamWriter, reply: dict[str, Any]) -> None:
    writer.write(json.dumps(reply, ensure_ascii=False).encode() + b"\n")
    await writer.drain()


def send_request(name: str, request: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Send `request` to the deployment that runs under `name`; yields its replies.

    Raises `instances.Unavailable` if the deployment does not reply. Whether it replies at all is
    known after `REPLY_TIMEOUT_S`, also for requests whose reply comes late.
    """
    late_reply = request != _STATUS
    if late_reply:
        for _ in send_request(name, _STATUS):
            pass
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
        connection.settimeout(REPLY_TIMEOUT_S)
        try:
            _connect(connection, instances.folder_of(name) / instances.SOCKET)
            connection.sendall(json.dumps(request).encode() + b"\n")
            if late_reply:
                connection.settimeout(None)
            with connection.makefile("rb") as replies:
                for line in replies:
                    yield json.loads(line)
        except TimeoutError:
            message = f"`{name}` does not respond within {REPLY_TIMEOUT_S:g} s"
            hint = "its rcdeploy may be stopped (`kill -CONT` with its pid continues it)"
            raise instances.Unavailable(f"{message}; {hint}") from None
        except OSError as error:
            message = f"`{name}` does not respond: {error.strerror}"
            raise instances.Unavailable(message) from None


def _connect(connection: socket.socket, path: Path) -> None:
    """Connect within the timeout of `connection`, also while the backlog of the server is full."""
    deadline = time.monotonic() + REPLY_TIMEOUT_S
    with instances.shorten_socket_path(path) as address:
        while True:
            try:
                connection.connect(address)
            except BlockingIOError:
                if time.monotonic() > deadline:
                    raise TimeoutError from None
                time.sleep(_CONNECT_PERIOD_S)
            else:
                return

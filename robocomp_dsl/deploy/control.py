"""How another terminal talks to a running deployment: lines of JSON over a Unix socket.

The server, in the event loop of the engine, answers `status`, `logs` and `stop`; the client is
blocking and yields the answers. A `stop` is answered when everything has ended.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeAlias

from robocomp_dsl.deploy import folder
from robocomp_dsl.deploy.logs import Record
from robocomp_dsl.deploy.status import Row, Time

KEPT = 10_000
"""Records that `logs` can show of the past; a slow reader falls back by as many, too."""
Wanted: TypeAlias = Callable[[Record], bool]


class Journal:
    """The latest records, and those who follow."""

    def __init__(self) -> None:
        self._kept: deque[Record] = deque(maxlen=KEPT)
        self._followers: set[asyncio.Queue[Record]] = set()

    def add(self, record: Record) -> None:
        """Keep `record` and pass it on."""
        self._kept.append(record)
        for queue in self._followers:
            if queue.full():
                queue.get_nowait()
            queue.put_nowait(record)

    def last(self, count: int, of: Wanted) -> list[Record]:
        """The latest `count` records that are wanted, oldest first."""
        kept = [record for record in self._kept if of(record)]
        return kept[-count:] if count > 0 else []

    @contextlib.contextmanager
    def follow(self) -> Iterator[asyncio.Queue[Record]]:
        """A queue that gets every record from now on."""
        queue: asyncio.Queue[Record] = asyncio.Queue(KEPT)
        self._followers.add(queue)
        try:
            yield queue
        finally:
            self._followers.discard(queue)


class Server:
    """Answers other terminals until `close`."""

    def __init__(
        self,
        journal: Journal,
        rows: Callable[[], list[Row]],
        stop: Callable[[str], None],
        time: Callable[[], Time | None],
    ) -> None:
        self._journal = journal
        self._rows = rows
        self._stop = stop
        self._time = time
        self._ended: asyncio.Future[dict[str, Any]] | None = None
        self._talks: set[asyncio.Task[None]] = set()

    async def open(self, path: Path) -> None:
        """Listen at `path`; the folder lets only this user in."""
        self._ended = asyncio.get_running_loop().create_future()
        with folder.short(path) as name:
            self._server = await asyncio.start_unix_server(self._talk, name)

    async def close(self, outcome: dict[str, Any]) -> None:
        """Tell those who wait for the end, and end."""
        assert self._ended is not None  # noqa: S101 - it was opened
        self._ended.set_result(outcome)
        self._server.close()
        if self._talks:
            await asyncio.wait(self._talks, timeout=1.0)

    async def _talk(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None  # noqa: S101 - this is one
        self._talks.add(task)
        try:
            with contextlib.suppress(OSError, ValueError, asyncio.LimitOverrunError):
                request = json.loads(await reader.readline())
                # Whatever else JSON can hold is no request, and gets no answer.
                if isinstance(request, dict):
                    await self._answer(request, reader, writer)
        finally:
            writer.close()
            self._talks.discard(task)

    async def _answer(
        self, request: dict[str, Any], reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        match request.get("verb"):
            case "status":
                rows, time = self._rows(), self._time()
                clock = time.as_dict() if time else None
                await _send(writer, {"rows": [row.as_dict() for row in rows], "clock": clock})
            case "logs":
                await self._logs(request, reader, writer)
            case "stop":
                self._stop("asked to by `rcdeploy stop`")
                assert self._ended is not None  # noqa: S101 - it was opened
                await _send(writer, await asyncio.shield(self._ended))

    async def _logs(
        self, request: dict[str, Any], reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        names = request.get("components")

        def wanted(record: Record) -> bool:
            return not names or record.component in names

        async def send(record: Record) -> None:
            if wanted(record):
                await _send(writer, asdict(record))

        with self._journal.follow() as queue:
            for record in self._journal.last(int(request.get("last", KEPT)), wanted):
                await send(record)
            if not request.get("follow"):
                return
            assert self._ended is not None  # noqa: S101 - it was opened
            gone = asyncio.ensure_future(reader.read())
            while not (gone.done() or self._ended.done()):
                item = asyncio.ensure_future(queue.get())
                any_of: list[asyncio.Future[Any]] = [item, gone, self._ended]
                await asyncio.wait(any_of, return_when=asyncio.FIRST_COMPLETED)
                if item.done():
                    await send(item.result())
                item.cancel()
            gone.cancel()
            while not queue.empty():
                await send(queue.get_nowait())


async def _send(writer: asyncio.StreamWriter, answer: dict[str, Any]) -> None:
    writer.write(json.dumps(answer, ensure_ascii=False).encode() + b"\n")
    await writer.drain()


def ask(name: str, request: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Send `request` to the deployment that runs under `name`; its answers as they come.

    Raises `folder.Unavailable` when nobody answers.
    """
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as one:
        try:
            with folder.short(folder.folder_of(name) / folder.SOCKET) as address:
                one.connect(address)
            one.sendall(json.dumps(request).encode() + b"\n")
        except OSError as error:
            said = f"`{name}` does not answer: {error.strerror}"
            raise folder.Unavailable(said) from None
        with one.makefile("rb") as answers:
            for line in answers:
                yield json.loads(line)

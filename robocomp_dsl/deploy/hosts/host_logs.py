"""Reads the logs of a deployment from all its hosts, in the order of time.

In: hosts, and which part of the logs. Out: records. A reader that follows connects again after a
link was cut, and goes on at the byte where it was, so that no line is lost or comes twice.
"""

from __future__ import annotations

import asyncio
import heapq
import json
import time
from collections.abc import AsyncGenerator, AsyncIterator, Callable, Collection, Iterable, Mapping
from contextlib import aclosing
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.hosts.connection import connect
from robocomp_dsl.deploy.hosts.errors import HostError, HostUnreachable
from robocomp_dsl.deploy.hosts.log_records import FileRecords
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.units.names import root_folder
from robocomp_dsl.model.deployment import Host

SCRIPT = Path(__file__).with_name("log_script.py")
RECONNECT_S = 1.0
SILENCE_S = 10.0
"""The script sends something every second; after so long the link is taken for cut."""
REORDER_S = 0.4
"""Records of several hosts wait so long for earlier ones of slower hosts."""


@dataclass(frozen=True, slots=True)
class LogRequest:
    """Which lines: of these components (empty: all), since a time, the last ones of each file.

    `members` are the components of groups that run in one process, by name of the group.
    """

    components: Collection[str] = ()
    since: float = 0.0
    last: int = -1
    members: Mapping[str, Collection[str]] = field(default_factory=dict)

    def files(self) -> list[str]:
        """The processes with logs of the components; empty: all."""
        owners = {member: group for group, names in self.members.items() for member in names}
        return sorted({owners.get(name, name) for name in self.components})


@dataclass(slots=True)
class HostLogReader:
    """Reads the logs of one host. `offsets` are where each file is to be continued."""

    host: Host
    deployment: str
    request: LogRequest
    offsets: dict[str, int] = field(default_factory=dict)
    _files: dict[str, FileRecords] = field(default_factory=dict)

    async def read(self, *, follow: bool) -> AsyncIterator[list[LogRecord]]:
        """Chunks of records; an empty one ends the first pass. Raises `HostError`."""
        connection = await connect(self.host, SILENCE_S)
        try:
            command = ["python3", "-c", SCRIPT.read_text("utf-8"), self._arguments(follow=follow)]
            frames = _Frames(connection.stream(command), self.host)
            is_live = False
            async with aclosing(frames):
                while head := await frames.next_head():
                    if "component" in head:
                        yield self._records(head, await frames.take(head["length"]), is_live)
                    elif "done" in head:
                        is_live = True
                        yield []
            if not is_live or follow:
                raise HostUnreachable(f"{self.host.name}: the connection was lost")
        finally:
            await connection.close()

    def _arguments(self, *, follow: bool) -> str:
        return json.dumps(
            {
                "root": root_folder(self.deployment),
                "components": self.request.files(),
                "offsets": self.offsets,
                "last": self.request.last,
                "since": self.request.since,
                "follow": follow,
            }
        )

    def _records(self, head: dict[str, Any], data: bytes, is_live: bool) -> list[LogRecord]:
        component = str(head["component"])
        files = self._files.get(component)
        if files is None:
            members = self.request.members.get(component, ())
            files = self._files[component] = FileRecords(component, self.host.name, members)
        if is_live:
            files.arrived(float(head["time"]))
        self.offsets[component] = int(head["offset"]) + len(data)
        return files.feed(data, float(head["time"]))


class _Frames:
    """Splits a stream into JSON lines and blocks of bytes."""

    def __init__(self, chunks: AsyncIterator[bytes], host: Host) -> None:
        self._chunks = chunks
        self._host = host
        self._buffer = bytearray()

    async def aclose(self) -> None:
        close = getattr(self._chunks, "aclose", None)
        if close:
            await close()

    async def next_head(self) -> dict[str, Any]:
        """The next JSON line; empty at the end."""
        line = b""
        while not line.startswith(b"{"):  # a login script may print something
            while (end := self._buffer.find(b"\n")) < 0:
                if not await self._fill():
                    return {}
            line = bytes(self._buffer[:end])
            del self._buffer[: end + 1]
        head: dict[str, Any] = json.loads(line)
        return head

    async def take(self, length: int) -> bytes:
        """The next `length` bytes. Raises `HostUnreachable` if they do not come."""
        while len(self._buffer) < length:
            if not await self._fill():
                raise HostUnreachable(f"{self._host.name}: the connection was lost")
        data = bytes(self._buffer[:length])
        del self._buffer[:length]
        return data

    async def _fill(self) -> bool:
        try:
            async with asyncio.timeout(SILENCE_S):
                self._buffer += await anext(self._chunks)
        except StopAsyncIteration:
            return False
        except TimeoutError:
            text = f"{self._host.name}: no sign of life for {SILENCE_S:g} s"
            raise HostUnreachable(text) from None
        return True


async def read_past(
    readers: Iterable[HostLogReader], on_error: Callable[[HostError], object]
) -> list[LogRecord]:
    """All records that the hosts have now, in the order of time."""

    async def read(reader: HostLogReader) -> list[LogRecord]:
        found: list[LogRecord] = []
        try:
            async for records in reader.read(follow=False):
                found += records
        except HostError as error:
            on_error(error)
        return found

    found = await asyncio.gather(*map(read, readers))
    return list(heapq.merge(*(sorted(each, key=_moment) for each in found), key=_moment))


def _moment(record: LogRecord) -> float:
    return record.time


async def follow_logs(
    readers: Iterable[HostLogReader], on_error: Callable[[HostError], object]
) -> AsyncGenerator[LogRecord, None]:
    """The records that the hosts have from now on, in the order of time, until it is closed."""
    arrived: asyncio.Queue[list[LogRecord]] = asyncio.Queue(maxsize=1000)

    async def follow(reader: HostLogReader) -> None:
        while True:
            try:
                async for records in reader.read(follow=True):
                    await arrived.put(records)
            except HostError as error:
                on_error(error)
            await asyncio.sleep(RECONNECT_S)

    tasks = [asyncio.create_task(follow(reader)) for reader in readers]
    waiting: list[tuple[float, int, float, LogRecord]] = []
    numbers = count()
    try:
        while True:
            due = waiting[0][2] - time.monotonic() if waiting else None
            try:
                async with asyncio.timeout(max(due, 0.0) if due is not None else None):
                    records = await arrived.get()
            except TimeoutError:
                records = []
            release = time.monotonic() + REORDER_S
            for record in records:
                heapq.heappush(waiting, (record.time, next(numbers), release, record))
            while waiting and waiting[0][2] <= time.monotonic():
                yield heapq.heappop(waiting)[3]
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

"""Copies trees to a host: only what it lacks.

In: a connection, trees. Out: blobs and complete trees below the deployment's folder on the host.
Small files travel in packs, large ones in chunks over several channels; an interrupted copy goes on
where it ended.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.content.host_session import ContentError, HostSession
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts.connection import HostConnection
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.regular_file import open_regular

PACK_BYTES = 4 << 20
CHUNK_BYTES = 4 << 20
CHANNELS = 3

Progress = Callable[[int, int], None]
"""Called with the bytes that are copied, and those of the whole copy."""


@dataclass(frozen=True, slots=True)
class Blob:
    """A content that a host needs: its name there, its size, and the file that has it here."""

    name: str
    size: int
    source: str


@dataclass(frozen=True, slots=True)
class HostState:
    """What a host lacks, and the free space of its file system.

    `chunks` are the parts of large blobs that an interrupted copy left there. `home` is the
    absolute path of the user's home.
    """

    free_bytes: int
    home: str
    trees: frozenset[str]
    blobs: tuple[Blob, ...]
    chunks: dict[str, list[str]]

    @property
    def missing_bytes(self) -> int:
        """Bytes to copy; parts that are there already are counted, too."""
        return sum(blob.size for blob in self.blobs)


@dataclass(slots=True)
class CopyResult:
    """What was copied to a host, in `seconds`."""

    files: int = 0
    bytes: int = 0
    trees: int = 0
    seconds: float = 0.0

    def __add__(self, other: CopyResult) -> CopyResult:
        return CopyResult(
            self.files + other.files,
            self.bytes + other.bytes,
            self.trees + other.trees,
            self.seconds + other.seconds,
        )


def blobs_of(trees: Iterable[ContentTree]) -> dict[str, Blob]:
    """The contents of trees, by name."""
    return {
        file.blob: Blob(file.blob, file.size, file.source) for tree in trees for file in tree.files
    }


async def find_lacking(
    session: HostSession, trees: Sequence[ContentTree], blobs: Sequence[Blob] = ()
) -> HostState:
    """Which trees and blobs a host lacks: `blobs`, and those of its missing trees."""
    names = sorted({tree.hash for tree in trees})
    found = await session.call("find_lacking", {"trees": names, "blobs": []})
    missing = frozenset(found["trees"])
    needed = blobs_of(tree for tree in trees if tree.hash in missing)
    needed |= {blob.name: blob for blob in blobs}
    if needed:
        pairs = [(blob.name, blob.size) for blob in needed.values()]
        found |= await session.call("find_lacking", {"trees": [], "blobs": pairs}) | {"trees": []}
    lacking = tuple(needed[name] for name in found["blobs"])
    return HostState(found["free_bytes"], found["home"], missing, lacking, found["chunks"])


async def upload_trees(
    connection: HostConnection,
    root: str,
    trees: Sequence[ContentTree],
    *,
    python: str = "python3",
    progress: Progress | None = None,
) -> CopyResult:
    """Copy what a host lacks of `trees` and build them there. Raises `HostError`.

    `root` is the deployment's folder, relative to the user's home; `python` is that of the host.
    """
    async with HostSession(connection, root, python) as session:
        state = await find_lacking(session, trees)
        result = await upload_blobs(connection, session, state, progress)
        started = time.monotonic()
        missing = {tree.hash: manifest_of(tree) for tree in trees if tree.hash in state.trees}
        if missing:
            await session.call("build_trees", {"trees": missing})
        result.trees = len(missing)
        result.seconds += time.monotonic() - started
    return result


async def upload_blobs(
    connection: HostConnection,
    session: HostSession,
    state: HostState,
    progress: Progress | None = None,
) -> CopyResult:
    """Copy the blobs that a host lacks. Raises `HostError`."""
    started = time.monotonic()
    large = [blob for blob in state.blobs if blob.size > CHUNK_BYTES]
    jobs = [*_packs(state.blobs), *(job for blob in large for job in _chunks(blob))]
    pending = deque(job for job in jobs if not _is_there(job, state.chunks))
    result = CopyResult(files=len(state.blobs))
    failures: list[HostError] = []
    there = state.missing_bytes - sum(job.size for job in pending)

    async def work(channel: HostSession) -> None:
        while pending:
            job = pending.popleft()
            await _send(channel, job)
            result.bytes += job.size
            if progress:
                progress(there + result.bytes, state.missing_bytes)

    async def work_until_failure(channel: HostSession) -> None:
        try:
            if channel is session:
                await work(channel)
                return
            async with channel:
                await work(channel)
        except HostError as error:
            failures.append(error)
            pending.clear()  # the others end after their present job

    more = max(0, min(CHANNELS, len(pending)) - 1)
    channels = [HostSession(connection, session.root, session.python) for _ in range(more)]
    await asyncio.gather(*map(work_until_failure, [session, *channels]))
    if failures:
        raise failures[0]
    for blob in large:
        sizes = [job.size for job in _chunks(blob)]
        answer = await session.call("join_chunks", {"name": blob.name, "sizes": sizes})
        _check_intact(answer, [blob])
    result.seconds = time.monotonic() - started
    return result


@dataclass(frozen=True, slots=True)
class _Job:
    """A pack of small blobs, or with an `index` one chunk of a large blob."""

    blobs: tuple[Blob, ...]
    size: int
    index: int = -1

    def read(self) -> bytes:
        """What is sent. Raises `ContentError` if a file is gone or shorter."""
        if self.index < 0:
            return b"".join(_read(blob, 0, blob.size) for blob in self.blobs)
        return _read(self.blobs[0], self.index * CHUNK_BYTES, self.size)


def _packs(blobs: Sequence[Blob]) -> Iterator[_Job]:
    pack: list[Blob] = []
    size = 0
    for blob in blobs:
        if blob.size > CHUNK_BYTES:
            continue
        if pack and size + blob.size > PACK_BYTES:
            yield _Job(tuple(pack), size)
            pack, size = [], 0
        pack.append(blob)
        size += blob.size
    if pack:
        yield _Job(tuple(pack), size)


def _chunks(blob: Blob) -> Iterator[_Job]:
    for index, start in enumerate(range(0, blob.size, CHUNK_BYTES)):
        yield _Job((blob,), min(CHUNK_BYTES, blob.size - start), index)


def _is_there(job: _Job, chunks: dict[str, list[str]]) -> bool:
    return f"{job.index}-{job.size}" in chunks.get(job.blobs[0].name, ())


async def _send(session: HostSession, job: _Job) -> None:
    payload = await asyncio.to_thread(job.read)
    if job.index >= 0:
        await session.call("store_chunk", {"name": job.blobs[0].name, "index": job.index}, payload)
        return
    pairs = [(blob.name, blob.size) for blob in job.blobs]
    _check_intact(await session.call("store_blobs", {"blobs": pairs}, payload), job.blobs)


def _check_intact(answer: dict[str, Any], blobs: Sequence[Blob]) -> None:
    """Raises `ContentError` for a blob whose content is not the one that was hashed."""
    damaged = [blob.source for blob in blobs if blob.name in answer["damaged"]]
    if damaged:
        raise _changed(damaged[0])


def _read(blob: Blob, start: int, size: int) -> bytes:
    try:
        with open_regular(Path(blob.source)) as stream:
            stream.seek(start)
            content = stream.read(size)
    except OSError as error:
        raise ContentError(f"{blob.source}: {error.strerror or error}", "changed") from None
    if len(content) != size:
        raise _changed(blob.source)
    return content


def _changed(source: str) -> ContentError:
    return ContentError(f"{source} changed while it was copied; run the command again", "changed")


def manifest_of(tree: ContentTree) -> dict[str, Any]:
    """A tree as `on_host.files.build_trees` reads it."""
    return {
        "files": [(file.path, file.blob, file.size) for file in tree.files],
        "folders": [*tree.folders, tree.working_folder],
    }

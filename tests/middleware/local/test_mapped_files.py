"""What a peer may send as a memory file, and what becomes of it."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.middleware.local import mapped_files
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket, MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import PADDING, MemoryPool
from tests.middleware.local.direct import open_descriptors

SIZE = 100_000


def received(size: int = SIZE, value: int = 1) -> int:
    """A descriptor as a receiver has it."""
    message = MemoryPool().message((bytes((value,)) * size,), size)
    return os.dup(message.descriptor)


def unsealed() -> int:
    descriptor = os.memfd_create("test")
    os.ftruncate(descriptor, 2 * SIZE)
    return descriptor


def writable_file(folder: Path) -> int:
    return os.open(folder / "file", os.O_CREAT | os.O_RDWR)


@pytest.mark.parametrize(
    "descriptor",
    [
        pytest.param(lambda _: unsealed(), id="not sealed"),
        pytest.param(lambda _: os.memfd_create("test", os.MFD_ALLOW_SEALING), id="empty"),
        pytest.param(lambda _: os.open("/dev/null", os.O_RDONLY), id="device"),
        pytest.param(lambda _: os.open("/dev/zero", os.O_RDWR), id="zeros"),
        pytest.param(writable_file, id="file"),
        pytest.param(lambda folder: os.open(folder, os.O_RDONLY), id="folder"),
        pytest.param(lambda _: received(SIZE // 4), id="too short"),
        pytest.param(lambda _: os.pidfd_open(os.getpid()), id="process"),
    ],
)
def test_view_rejects_other_descriptors_and_closes_them(
    descriptor: Callable[[Path], int], tmp_path: Path
) -> None:
    before, files = open_descriptors(), MappedFiles()
    with pytest.raises(MalformedPacket):
        files.view(descriptor(tmp_path), SIZE)
    del files
    assert open_descriptors() == before


@pytest.mark.parametrize("size", [1 << 31, (1 << 64) - 1, (1 << 64) - 5])
def test_view_rejects_sizes_beyond_the_file(size: int) -> None:
    with pytest.raises(MalformedPacket):
        MappedFiles().view(received(), size)


def test_view_is_read_only_and_aligned() -> None:
    array = np.frombuffer(MappedFiles().view(received(), SIZE), np.uint8)
    assert not array.flags.writeable
    assert (array.__array_interface__["data"][0] + len(PADDING)) % 8 == 0


def test_peer_cannot_truncate_a_mapped_file() -> None:
    descriptor = received()
    view = MappedFiles().view(os.dup(descriptor), SIZE)
    writable = os.open(f"/proc/self/fd/{descriptor}", os.O_RDWR)
    with pytest.raises(PermissionError):
        os.ftruncate(writable, 0)
    assert fcntl.fcntl(descriptor, fcntl.F_GET_SEALS) & fcntl.F_SEAL_SHRINK
    os.close(writable)
    os.close(descriptor)
    assert bytes(view[:3]) == b"\1\1\1"


def test_view_copies_when_many_messages_are_in_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mapped_files, "MAX_VIEWS", len(mapped_files._views) + 3)
    files, before = MappedFiles(), open_descriptors()
    views = [files.view(received(value=n), SIZE) for n in range(8)]
    assert [type(view) for view in views] == [memoryview] * 3 + [bytes] * 5
    assert [view[0] for view in views] == list(range(8))
    del views, files
    assert open_descriptors() == before


def test_files_forget_what_was_not_used_for_long() -> None:
    files, before = MappedFiles(), open_descriptors()
    for _ in range(4 * mapped_files.MAX_FILES):
        files.view(received(), SIZE)
    assert open_descriptors() - before <= mapped_files.MAX_FILES

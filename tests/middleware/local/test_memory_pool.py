"""Memory files are written again when nobody reads them, and never before."""

from __future__ import annotations

import os
import socket
import subprocess
import sys

import numpy as np
import pytest

from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError
from robocomp_dsl.runtime.middleware.local import memory_pool
from robocomp_dsl.runtime.middleware.local.mapped_files import MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool, SharedMessage
from tests.middleware.local.direct import open_descriptors

SIZE = 100_000


def inode(message: SharedMessage) -> int:
    return os.fstat(message.descriptor).st_ino


def message_of(pool: MemoryPool, value: int, size: int = SIZE) -> SharedMessage:
    return pool.message((bytes((value,)) * size,), size)


def test_memory_pool_uses_a_file_again_after_its_message() -> None:
    pool = MemoryPool()
    first = inode(message_of(pool, 1))
    assert {inode(message_of(pool, n)) for n in range(5)} == {first}


def test_memory_pool_uses_another_file_while_a_message_exists() -> None:
    pool = MemoryPool()
    messages = [message_of(pool, n) for n in range(3)]
    assert len({inode(message) for message in messages}) == 3
    files = MappedFiles()
    for number, message in enumerate(messages):
        view = files.view(os.dup(message.descriptor), SIZE)
        assert set(np.frombuffer(view, np.uint8)) == {number}


def test_memory_pool_waits_for_a_message_in_a_socket() -> None:
    pool = MemoryPool()
    message = message_of(pool, 1)
    first = inode(message)
    here, there = socket.socketpair()
    with here, there:
        socket.send_fds(here, [b"x"], [message.descriptor])
        del message
        assert inode(message_of(pool, 2)) != first
    del here, there
    assert first in {inode(message_of(pool, 3)) for _ in range(2)} | {
        inode(message) for message in [message_of(pool, 4), message_of(pool, 5)]
    }


def test_memory_pool_waits_for_the_last_array_of_a_receiver() -> None:
    pool, files = MemoryPool(), MappedFiles()
    message = message_of(pool, 1)
    first = inode(message)
    array = np.frombuffer(files.view(os.dup(message.descriptor), SIZE), np.uint8)[10:20]
    del message
    for value in range(2, 5):
        assert inode(message_of(pool, value)) != first
    assert set(array) == {1}
    del array
    messages = [message_of(pool, 9) for _ in range(3)]
    assert first in {inode(message) for message in messages}


def test_memory_pool_does_not_wait_for_a_killed_receiver() -> None:
    pool = MemoryPool()
    message = message_of(pool, 1)
    first = inode(message)
    # Another process that keeps the descriptor of the message.
    script = "import sys; print('ready', flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", script],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        pass_fds=(message.descriptor,),
    ) as receiver:
        assert receiver.stdout
        receiver.stdout.readline()
        del message
        assert inode(message_of(pool, 2)) != first
        receiver.kill()
        receiver.wait()
    messages = [message_of(pool, 3), message_of(pool, 4)]
    assert first in {inode(each) for each in messages}


def test_memory_pool_writes_all_parts_of_new_and_used_files() -> None:
    pool = MemoryPool()
    parts = (b"head", np.arange(50_000, dtype=np.int16), b"", np.arange(3, dtype=np.float64))
    expected = b"".join(parts)
    for _ in range(3):
        message = pool.message(parts, len(expected))
        assert bytes(MappedFiles().view(os.dup(message.descriptor), message.size)) == expected
        del message


def test_memory_pool_joins_thousands_of_parts() -> None:
    parts = [bytes((n % 256,)) * 30 for n in range(5000)]
    message = MemoryPool().message(parts, 150_000)
    assert bytes(MappedFiles().view(os.dup(message.descriptor), 150_000)) == b"".join(parts)


def test_memory_pool_keeps_a_limited_number_of_files() -> None:
    pool, before = MemoryPool(), open_descriptors()
    messages = [message_of(pool, 1) for _ in range(3 * memory_pool.MAX_FILES)]
    del messages
    message_of(pool, 1)
    assert open_descriptors() - before <= 2 * memory_pool.MAX_FILES


def test_memory_pool_keeps_a_limited_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory_pool, "MAX_POOL_BYTES", 1 << 20)
    pool, before = MemoryPool(), open_descriptors()
    message_of(pool, 1, 2_000_000)
    assert open_descriptors() == before


def test_memory_pool_forgets_idle_files(monkeypatch: pytest.MonkeyPatch) -> None:
    pool, before = MemoryPool(), open_descriptors()
    messages = [message_of(pool, 1) for _ in range(5)]
    del messages
    monkeypatch.setattr(memory_pool, "IDLE_S", 0.0)
    message_of(pool, 1)
    assert open_descriptors() - before <= 2  # of one file, which is mapped


def test_memory_pool_refuses_a_message_that_is_too_long() -> None:
    with pytest.raises(EncodeError, match="more than a message of `local` may have"):
        MemoryPool().message((b"x",), memory_pool.MAX_MESSAGE_BYTES + 1)


def test_memory_pool_without_descriptors_raises_a_middleware_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(*_: object) -> int:
        raise OSError(24, "Too many open files")

    monkeypatch.setattr(os, "memfd_create", fail)
    with pytest.raises(MiddlewareError, match="no memory for a message of 100000 bytes: Too many"):
        message_of(MemoryPool(), 1)

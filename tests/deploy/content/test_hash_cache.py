"""The cache of hashes: reads a file only if it changed, and survives damage."""

from __future__ import annotations

import hashlib
import os
import time
from pathlib import Path

import pytest

from robocomp_dsl.deploy.content.hash_cache import HashCache
from tests.deploy.content.workspace_files import write_files

OLD = time.time() - 3600


def old_file(path: Path, content: bytes) -> None:
    """A file that nobody has changed for an hour, but for its status."""
    write_files(path.parent, {path.name: content})
    os.utime(path, (OLD, OLD))


def hashed(cache: HashCache, path: Path) -> str:
    return cache.sha256(str(path), path.stat())


@pytest.fixture
def settled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every file counts as settled: its status changed when the test wrote it."""
    monkeypatch.setattr("robocomp_dsl.deploy.content.hash_cache._SETTLED_NS", -1)


@pytest.mark.usefixtures("settled")
def test_hash_cache_reads_unchanged_file_once(tmp_path: Path) -> None:
    file = tmp_path / "file"
    old_file(file, b"content")
    first = HashCache(tmp_path / "hashes.json")
    assert hashed(first, file) == hashlib.sha256(b"content").hexdigest()
    first.save()
    second = HashCache(tmp_path / "hashes.json")
    assert hashed(second, file) == hashed(first, file)
    assert (first.reads, second.reads) == (1, 0)


@pytest.mark.usefixtures("settled")
def test_hash_cache_sees_change_that_keeps_size_and_time(tmp_path: Path) -> None:
    file = tmp_path / "file"
    old_file(file, b"content")
    cache = HashCache(tmp_path / "hashes.json")
    hashed(cache, file)
    old_file(file, b"CONTENT")
    assert hashed(cache, file) == hashlib.sha256(b"CONTENT").hexdigest()


def test_hash_cache_does_not_trust_new_files(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"x")
    cache = HashCache(tmp_path / "hashes.json")
    hashed(cache, file)
    hashed(cache, file)
    assert cache.reads == 2  # it may change again within one tick of the clock


@pytest.mark.usefixtures("settled")
@pytest.mark.parametrize(
    "damage", [b"", b"{", b"[]", b'{"version": 1}', b'{"version": 1, "files": [[1]]}', b"\xff\xfe"]
)
def test_hash_cache_ignores_damaged_file(tmp_path: Path, damage: bytes) -> None:
    file, path = tmp_path / "file", tmp_path / "hashes.json"
    old_file(file, b"content")
    path.write_bytes(damage)
    cache = HashCache(path)
    assert hashed(cache, file) == hashlib.sha256(b"content").hexdigest()
    cache.save()
    assert HashCache(path).sha256(str(file), file.stat())


@pytest.mark.usefixtures("settled")
def test_hash_cache_works_without_writable_folder(tmp_path: Path) -> None:
    file = tmp_path / "file"
    old_file(file, b"content")
    (tmp_path / "blocked").write_text("a file, not a folder")
    cache = HashCache(tmp_path / "blocked" / "hashes.json")
    assert hashed(cache, file)
    cache.save()
    assert (tmp_path / "blocked").is_file()

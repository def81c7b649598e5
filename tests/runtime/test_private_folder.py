"""Private folders: only a folder of this user that nobody else can enter is used."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from robocomp_dsl.deploy import instances
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.file_lock import try_lock, wait_for_lock
from robocomp_dsl.runtime.presence.domain_session import open_session
from robocomp_dsl.runtime.private_folder import (
    UnsafeFolder,
    private_folder,
    read_token,
    token_file,
    user_folder,
)
from tests.deploy.rcdeploy_process import runtime_folder


@pytest.fixture
def base(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    with runtime_folder(monkeypatch) as path:
        yield path.parent


def make_link(path: Path) -> None:
    target = path.with_name("target")
    target.mkdir(mode=0o700)
    path.symlink_to(target)


def make_open(path: Path) -> None:
    path.mkdir()
    path.chmod(0o750)


def make_foreign(path: Path) -> None:
    path.mkdir(mode=0o700)
    try:
        os.chown(path, 12345, 12345)
    except PermissionError:
        pytest.skip("only root can give a folder to another user")


UNSAFE = [
    (make_link, "is a symbolic link; delete it"),
    (make_open, r"is open to other users \(mode 750\); .* `chmod 700 "),
    (make_foreign, r"belongs to another user \(uid 12345\); set XDG_RUNTIME_DIR"),
    (Path.touch, "cannot be used: File exists; set XDG_RUNTIME_DIR"),
]


@pytest.mark.parametrize(("make", "message"), UNSAFE)
def test_unsafe_user_folder_is_refused_by_components_and_rcdeploy(
    base: Path, make: object, message: str
) -> None:
    make(base / f"robocomp-{os.getuid()}")  # type: ignore[operator]
    with pytest.raises(UnsafeFolder, match=message):
        user_folder()
    with pytest.raises(MiddlewareError, match=message):
        open_session("lab", name="arm")
    with pytest.raises(instances.Unavailable, match=message):
        instances.running()


@pytest.mark.parametrize(("make", "message"), UNSAFE)
def test_unsafe_domain_folder_is_refused(base: Path, make: object, message: str) -> None:
    make(user_folder() / "lab")  # type: ignore[operator]
    with pytest.raises(MiddlewareError, match=message):
        open_session("lab")
    assert [path.name for path in (base / "target").glob("*")] == []


def test_private_folder_ignores_the_umask_and_is_reused(base: Path) -> None:
    before = os.umask(0)
    try:
        assert private_folder(base / "x").stat().st_mode & 0o777 == 0o700
    finally:
        os.umask(before)
    assert private_folder(base / "x") == base / "x"


def test_token_is_created_once_by_many(base: Path) -> None:
    with ThreadPoolExecutor(8) as pool:
        tokens = set(pool.map(lambda _: read_token(user_folder()), range(64)))
    assert len(tokens) == 1
    assert len(tokens.pop()) == 32


@pytest.mark.parametrize("content", [b"", b"robocomp:", b"\xff" * 9, b"robocomp:short\n", b"a:b\n"])
def test_token_file_without_a_token_is_reported(base: Path, content: bytes) -> None:
    path = token_file(user_folder())
    path.write_bytes(content)
    with pytest.raises(UnsafeFolder, match="token"):
        read_token(user_folder())
    with pytest.raises(MiddlewareError, match="token"):
        open_session("lab")


def test_file_lock_is_exclusive_and_survives_deletion_of_its_file(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    first = try_lock(path)
    assert first is not None
    assert try_lock(path) is None
    assert wait_for_lock(path, 0.02) is None
    path.unlink()  # by somebody else
    second = try_lock(path)
    assert second is not None
    second.write("abcdef")
    second.write("abc")
    assert path.read_text() == "abc"
    second.release(delete=True)
    second.release(delete=True)
    assert not path.exists()
    first.release()


def test_file_lock_follows_no_link(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(tmp_path / "target")
    with pytest.raises(OSError, match="symbolic"):
        try_lock(tmp_path / "link")
    assert not (tmp_path / "target").exists()


def test_file_lock_is_not_inherited_by_child_processes(tmp_path: Path) -> None:
    lock = try_lock(tmp_path / "lock")
    assert lock is not None
    child = subprocess.Popen([sys.executable, "-S", "-c", "input()"], stdin=subprocess.PIPE)
    try:
        lock.close()  # as the kernel does when the process is killed
        again = wait_for_lock(tmp_path / "lock", 30)
        assert again is not None
        again.release()
    finally:
        child.communicate(b"\n")

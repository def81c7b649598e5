"""The only writer: brings files onto the disk, all of them or none.

In: a folder and the files that it shall hold. Out: what was done to each; `CannotWrite` when
nothing was. Files are written beside their places and renamed when all are safe on the disk; an
equal file is not touched. A lock on the folder lets one writer in at a time.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from enum import StrEnum
from pathlib import Path
from threading import Thread

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.record import ValueRecord

try:
    import fcntl
except ImportError:  # no such locks on this system: renames still keep each file whole
    fcntl = None  # type: ignore[assignment]

TEMPORARY = ".rcgen-new"
"""Suffix of files that are not in their places yet."""
LOCK_TIMEOUT_S = 10.0


class CannotWrite(Exception):
    """The files cannot be written; the message says which and why, in words for the user."""


class FileAction(StrEnum):
    """What happens to a file."""

    CREATE = "create"
    UPDATE = "update"
    DELETE = "delete"
    SAME = "unchanged"
    KEEP = "keep"


class Change(ValueRecord):
    """One file, what happens to it, and its bytes until now (None if there is none)."""

    file: OutputFile
    action: FileAction
    old: bytes | None

    @property
    def pending(self) -> bool:
        """Whether there is something to write."""
        return self.action in (FileAction.CREATE, FileAction.UPDATE, FileAction.DELETE)


def compare(folder: Path, files: Iterable[OutputFile]) -> list[Change]:
    """What writing would do. Raises `CannotWrite`; writes nothing."""
    with _translate_os_errors(folder):
        _refuse_file(folder)
        return [_compared(folder, file) for file in files]


def write(folder: Path, files: Sequence[OutputFile]) -> list[Change]:
    """Write what differs. Raises `CannotWrite`; then the folder is as it was before."""
    undo = _Rollback()
    with _translate_os_errors(folder), undo:
        _refuse_file(folder)
        undo.make_folder(folder)
        with _locked(folder):
            changes = [_compared(folder, file) for file in files]
            pending = [planned for planned in changes if planned.pending]
            temporaries = [
                (undo.write_beside(folder / c.file.path, c), c)
                for c in pending
                if c.action is not FileAction.DELETE
            ]
            _sync(temporary for temporary, _ in temporaries)
            for temporary, change in temporaries:
                undo.put_in_place(temporary, folder / change.file.path, change)
            removed = [c for c in pending if c.action is FileAction.DELETE]
            for change in removed:
                undo.remove(folder / change.file.path, change)
            _remove_leftovers({(folder / c.file.path) for c in removed})
            with suppress(OSError):  # some systems cannot do this with folders
                _sync({(folder / c.file.path).parent for c in pending})
    return changes


def _refuse_file(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise CannotWrite(f"`{folder}` is a file, not a folder")


def _compared(folder: Path, file: OutputFile) -> Change:
    path = folder / file.path
    if file.write_once and os.path.lexists(path):
        return Change(file, FileAction.KEEP, None)
    if not path.parent.resolve().is_relative_to(folder.resolve()):
        raise CannotWrite(f"`{path.parent}` is a link that leads out of `{folder}`")
    if path.is_symlink():
        raise CannotWrite(f"`{path}` is a link; remove it, this file is written by rcgen")
    if path.is_dir():
        raise CannotWrite(f"`{path}` is a folder, but a file must go there")
    try:
        old = path.read_bytes()
    except FileNotFoundError:
        return Change(file, FileAction.SAME if file.is_removed else FileAction.CREATE, None)
    if file.is_removed and old == file.expected_bytes:
        return Change(file, FileAction.DELETE, old)
    if file.expected_bytes is not None and old not in (file.expected_bytes, file.data):
        raise CannotWrite(f"`{path}` was changed by another program meanwhile; run rcgen again")
    return Change(file, FileAction.SAME if old == file.data else FileAction.UPDATE, old)


class _Rollback:
    """Remembers what was done; leaving it with an exception takes everything back."""

    def __init__(self) -> None:
        self._folders: list[Path] = []
        self._temporaries: list[Path] = []
        self._placed: list[tuple[Path, Change]] = []

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, *_: object) -> None:
        if kind is None:
            return
        for path, change in reversed(self._placed):
            with suppress(OSError):
                if change.old is None:
                    path.unlink()
                else:
                    path.write_bytes(change.old)
                    _sync([path])
        for path in self._temporaries:
            with suppress(OSError):
                path.unlink()
        for folder in reversed(self._folders):
            with suppress(OSError):
                folder.rmdir()

    def make_folder(self, folder: Path) -> None:
        missing = [p for p in (folder, *folder.parents) if not p.exists()]
        for path in reversed(missing):
            with suppress(FileExistsError):  # another writer was faster
                path.mkdir()
                self._folders.append(path)

    def write_beside(self, path: Path, change: Change) -> Path:
        self.make_folder(path.parent)
        temporary = path.with_name(f".{path.name}{TEMPORARY}")
        with suppress(FileNotFoundError):  # left by a writer that was killed
            temporary.unlink()
        self._temporaries.append(temporary)
        temporary.write_bytes(change.file.data)
        return temporary

    def put_in_place(self, temporary: Path, path: Path, change: Change) -> None:
        if change.old is not None:
            temporary.chmod(path.stat().st_mode & 0o7777)
        temporary.replace(path)
        self._placed.append((path, change))

    def remove(self, path: Path, change: Change) -> None:
        path.unlink()
        self._placed.append((path, change))


def _remove_leftovers(removed: Iterable[Path]) -> None:
    """Delete what Python compiled from removed modules, and folders that are empty then."""
    for path in removed:
        for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*.pyc"):
            with suppress(OSError):
                compiled.unlink()
    for folder in {path.parent for path in removed}:
        for empty in (folder / "__pycache__", folder):
            with suppress(OSError):
                empty.rmdir()


def _sync(paths: Iterable[Path]) -> None:
    """Wait until files or folders are safe on the disk; it takes those together that come together.

    Raises `OSError` if one is not.
    """
    failed: list[OSError] = []
    threads = [Thread(target=_sync_one, args=(path, failed)) for path in paths]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failed:
        raise failed[0]


def _sync_one(path: Path, failed: list[OSError]) -> None:
    try:
        descriptor = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        error.filename = error.filename or str(path)
        failed.append(error)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        _lock(descriptor, folder)
        yield
    finally:
        os.close(descriptor)  # which also gives the lock back


def _lock(descriptor: int, folder: Path) -> None:
    deadline = time.monotonic() + LOCK_TIMEOUT_S
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > deadline:
                raise CannotWrite(f"another rcgen is writing to `{folder}`") from None
            time.sleep(0.01)
        else:
            return


_REASONS = {
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk quota is used up",
    errno.EFBIG: "the limit for the size of files is reached",
    errno.EACCES: "you may not write there",
    errno.EPERM: "you may not write there",
    errno.EROFS: "the file system is read-only",
    errno.ENOTDIR: "a part of the path is a file, not a folder",
    errno.ENAMETOOLONG: "the path is too long",
}


@contextmanager
def _translate_os_errors(folder: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = _REASONS.get(error.errno or 0) or error.strerror or str(error)
        named = _target_path(Path(str(error.filename or folder)))
        raise CannotWrite(f"cannot write `{named}`: {reason}") from None


def _target_path(path: Path) -> Path:
    """The file of the user, for what was to be written beside it first."""
    if not path.name.endswith(TEMPORARY):
        return path
    return path.with_name(path.name.removesuffix(TEMPORARY).removeprefix("."))

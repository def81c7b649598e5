"""Registers running deployments: one folder per user, one locked entry per deployment name.

In: a name. Out: the lock on it, and the deployments that run. The kernel releases a file lock when
its process exits for any reason, so a stale entry is never taken for a running deployment; the next
reader deletes it.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import re
import shutil
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from robocomp_dsl.runtime.private_folder import UnsafeFolder, private_folder, user_folder

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,63}")
SOCKET = "control"
_STATE = "state.json"
_LOCK = "lock"
_LOCK_TIMEOUT_S = 1.0


@dataclass(frozen=True, slots=True)
class RunningDeployment:
    """A running deployment.

    `path` is its DDSL file, `pid` that of rcdeploy, `since` in seconds since 1970.
    """

    name: str
    path: str
    domain: str
    pid: int
    since: float


class Unavailable(Exception):
    """The name or the folder cannot be used; the message says why."""


@dataclass(frozen=True, slots=True)
class InstanceLock:
    """The lock on a deployment name, held until `release` or the end of the process."""

    folder: Path
    _lock: int

    def publish(self, running: RunningDeployment) -> None:
        """Write what runs under this name, for other processes to read."""
        new = self.folder / f"{_STATE}.new"
        new.write_text(json.dumps(asdict(running)), encoding="utf-8")
        new.replace(self.folder / _STATE)

    def release(self) -> None:
        """Delete the entry and release the lock."""
        shutil.rmtree(self.folder, ignore_errors=True)
        os.close(self._lock)


def instances_folder() -> Path:
    """The folder of this user's entries, created with mode 0700. Raises `Unavailable`.

    It lies beside the folders of the domains; no domain has this name.
    """
    try:
        return private_folder(user_folder() / ".deployments")
    except UnsafeFolder as error:
        raise Unavailable(str(error)) from None


def acquire(name: str) -> InstanceLock:
    """Lock `name`. Raises `Unavailable` if it is invalid or already in use."""
    if not NAME.fullmatch(name):
        raise Unavailable(
            f"`{name}` is not a valid name: use letters, digits, _ and -, starting with a letter"
        )
    folder = instances_folder() / name
    deadline = time.monotonic() + _LOCK_TIMEOUT_S
    while True:
        lock = _try_lock(folder)
        if lock is not None and _is_current(lock, folder):
            return InstanceLock(folder, lock)
        if lock is not None:
            os.close(lock)  # the previous holder deleted the folder in the meantime
            continue
        # `running` also holds the lock for a moment.
        state = _read_state(folder)
        if (state and _is_alive(state.pid)) or time.monotonic() > deadline:
            raise Unavailable(_already_running(name, state))
        time.sleep(0.01)


def running() -> list[RunningDeployment]:
    """The deployments that run now, by name. Deletes stale entries."""
    deployments = []
    for folder in sorted(instances_folder().iterdir()):
        lock = _try_lock(folder)
        if lock is not None:
            InstanceLock(folder, lock).release()
        elif (state := _read_state(folder)) is not None:
            deployments.append(state)
    return deployments


def folder_of(name: str) -> Path:
    """The folder with the control socket of the deployment that runs under `name`."""
    return instances_folder() / name


@contextlib.contextmanager
def shorten_socket_path(path: Path) -> Iterator[str]:
    """A path to `path` that fits into the address of a Unix socket (108 bytes on Linux)."""
    if len(os.fsencode(path)) < 100:
        yield str(path)
        return
    folder = os.open(path.parent, os.O_PATH | os.O_DIRECTORY)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)


def _try_lock(folder: Path) -> int | None:
    """The lock of `folder`, which is created if missing; None if another process holds it."""
    try:
        lock = _open_lock(folder)
    except OSError as error:
        raise Unavailable(f"{folder} cannot be used: {error.strerror}") from None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(lock)
        return None
    return lock


def _open_lock(folder: Path) -> int:
    while True:
        folder.mkdir(mode=0o700, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):  # deleted by another process
            return os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)


def _is_alive(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()


def _is_current(lock: int, folder: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(lock), (folder / _LOCK).stat())
    except FileNotFoundError:
        return False


def _read_state(folder: Path) -> RunningDeployment | None:
    """The published state; None until the holder of the lock has published it."""
    try:
        return RunningDeployment(**json.loads((folder / _STATE).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def _already_running(name: str, state: RunningDeployment | None) -> str:
    instance = f" (pid {state.pid}, {state.path})" if state else ""
    return f"`{name}` is already running{instance}; stop it, or use another --name"

"""Where running deployments are found: a folder per user, an entry per running name.

In: a name. Out: the claim on it, and what others have claimed. A claim is a file lock, which the
kernel lets go however its holder ends, so nothing stale is ever believed; the rest is swept by the
next one who looks.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,63}")
SOCKET = "control"
_STATE = "state.json"
_LOCK = "lock"
_PATIENCE_S = 1.0


@dataclass(frozen=True, slots=True)
class Running:
    """A running deployment.

    `path` is its DDSL file, `pid` that of rcdeploy, `since` in seconds since 1970.
    """

    name: str
    path: str
    domain: str
    pid: int
    since: float


class Unavailable(Exception):
    """The name or the folder cannot be used; says why, in words for the user."""


@dataclass(frozen=True, slots=True)
class Claim:
    """The right to run under a name, until `release` or the end of the process."""

    folder: Path
    _lock: int

    def tell(self, running: Running) -> None:
        """Say what runs under the claimed name."""
        new = self.folder / f"{_STATE}.new"
        new.write_text(json.dumps(asdict(running)), encoding="utf-8")
        new.replace(self.folder / _STATE)

    def release(self) -> None:
        """Give the name back."""
        shutil.rmtree(self.folder, ignore_errors=True)
        os.close(self._lock)


def base() -> Path:
    """The folder of this user, made if need be, closed to others. Raises `Unavailable`.

    It is beside those of the domains, and has a name that no domain has.
    """
    above = Path(os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir())
    folder = above / f"robocomp-{os.getuid()}" / ".deployments"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        found = folder.parent.stat()
        if found.st_uid == os.getuid() and stat.S_IMODE(found.st_mode) & 0o077:
            folder.parent.chmod(0o700)
    except OSError as error:
        raise Unavailable(f"{folder} cannot be made: {error.strerror}") from None
    if found.st_uid != os.getuid():
        raise Unavailable(f"{folder.parent} belongs to another user; set XDG_RUNTIME_DIR")
    return folder


def claim(name: str) -> Claim:
    """Take `name`. Raises `Unavailable` when it is no good name, or runs already."""
    if not NAME.fullmatch(name):
        raise Unavailable(f"`{name}` is no name: letters, digits, _ and -, beginning with a letter")
    folder = base() / name
    deadline = time.monotonic() + _PATIENCE_S
    while True:
        lock = _locked(folder)
        if lock is not None and _is_current(lock, folder):
            return Claim(folder, lock)
        if lock is not None:
            os.close(lock)  # its former holder removed the folder in between
            continue
        # Somebody who only looks has the lock for a moment, too.
        state = _state(folder)
        if (state and _is_alive(state.pid)) or time.monotonic() > deadline:
            raise Unavailable(_already(name, state))
        time.sleep(0.01)


def running() -> list[Running]:
    """What runs now, by name. What is left of others is removed."""
    found = []
    for folder in sorted(base().iterdir()):
        lock = _locked(folder)
        if lock is not None:
            Claim(folder, lock).release()
        elif (state := _state(folder)) is not None:
            found.append(state)
    return found


def folder_of(name: str) -> Path:
    """Where the deployment that runs under `name` keeps its socket."""
    return base() / name


@contextlib.contextmanager
def short(path: Path) -> Iterator[str]:
    """A name for `path` that fits into the address of a Unix socket (108 bytes on Linux)."""
    if len(os.fsencode(path)) < 100:
        yield str(path)
        return
    folder = os.open(path.parent, os.O_PATH | os.O_DIRECTORY)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)


def _locked(folder: Path) -> int | None:
    """The lock of `folder`, which is made if need be, or None when someone has it."""
    try:
        lock = _opened(folder)
    except OSError as error:
        raise Unavailable(f"{folder} cannot be used: {error.strerror}") from None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(lock)
        return None
    return lock


def _opened(folder: Path) -> int:
    while True:
        folder.mkdir(mode=0o700, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):  # removed by somebody who looked
            return os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)


def _is_alive(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()


def _is_current(lock: int, folder: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(lock), (folder / _LOCK).stat())
    except FileNotFoundError:
        return False


def _state(folder: Path) -> Running | None:
    """None in the moment between the claim and its first word."""
    try:
        return Running(**json.loads((folder / _STATE).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def _already(name: str, state: Running | None) -> str:
    who = f" (pid {state.pid}, {state.path})" if state else ""
    return f"`{name}` is running already{who}; stop it, or give this one another --name"

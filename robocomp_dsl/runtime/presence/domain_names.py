"""Names in a domain: each belongs to one running component, and to one deployment.

In: a domain and names. Out: locks on files that hold pid and start time. The kernel releases the
lock of a killed process, so that its name is free at once.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path
from typing import Literal
from urllib.parse import quote

from robocomp_dsl.runtime.file_lock import FileLock, try_lock, wait_for_lock
from robocomp_dsl.runtime.presence.domain_folder import (
    delete_if_unused,
    domain_folder,
    domain_path,
)

NameKind = Literal["component", "deployment"]
_CLAIM_TIMEOUT_S = 0.2
"""Longer than others look at the lock of a name."""
_MAX_FILE_NAME = 120


@dataclass(frozen=True, slots=True)
class NameHolder:
    """The process that has a name; `started` in seconds since 1970, 0 if unknown.

    `deployment` is the name of the deployment that reserved the name, or empty.
    """

    name: str
    pid: int = 0
    started: float = 0.0
    deployment: str = ""

    def describe(self) -> str:
        """`pid 4711, started 2026-11-22 20:15:04`; empty if unknown."""
        if not self.pid:
            return ""
        started = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(self.started))
        return f"pid {self.pid}, started {started}"


class NameTaken(Exception):
    """Another process has the name; the message says which, and what to do."""

    def __init__(self, domain: str, holder: NameHolder) -> None:
        self.holder = holder
        process = f" ({holder.describe()})" if holder.describe() else ""
        place = f"in the domain `{domain}`"
        if holder.deployment:
            text = f"is already used {place} by the deployment `{holder.deployment}`{process}"
        else:
            text = f"is already running {place}{process}"
        super().__init__(f"`{holder.name}` {text}; stop it, or use another name or --domain")


@dataclass(frozen=True, slots=True)
class NameReservation:
    """The names of a deployment, reserved until `release` or the end of the process."""

    folder: Path
    _locks: Sequence[FileLock]

    def release(self) -> None:
        """Let other deployments use the names."""
        for lock in self._locks:
            lock.release(delete=True)
        delete_if_unused(self.folder)


def claim_component(domain: str, name: str) -> FileLock:
    """The lock on a component's name. Raises `NameTaken`, `UnsafeFolder` or `OSError`."""
    return _claim(domain, NameHolder(name, os.getpid(), time.time()), "component")


def reserve(domain: str, names: Iterable[str], deployment: str) -> NameReservation:
    """Reserve all `names` for a deployment, or none.

    Raises `NameTaken` if a component or another deployment has one of them, `UnsafeFolder` or
    `OSError`.
    """
    locks: list[FileLock] = []
    ordered = sorted(names)
    try:
        # All deployments reserve in this order, so that one of two succeeds.
        for name in ordered:
            holder = NameHolder(name, os.getpid(), time.time(), deployment)
            locks.append(_claim(domain, holder, "deployment"))
        _refuse_running(domain, ordered)
    except BaseException:
        NameReservation(domain_path(domain), locks).release()
        raise
    return NameReservation(domain_path(domain), locks)


def _refuse_running(domain: str, names: Iterable[str]) -> None:
    if holders := running_components(domain, names):
        raise NameTaken(domain, holders[0])


def running_components(domain: str, names: Iterable[str]) -> list[NameHolder]:
    """Those of `names` that running components of the domain have. Raises `UnsafeFolder`."""
    folder = domain_path(domain)
    return [holder for name in names if (holder := _holder(folder, name, "component")) is not None]


def _claim(domain: str, holder: NameHolder, kind: NameKind) -> FileLock:
    while True:
        path = _lock_path(domain_folder(domain), holder.name, kind)
        try:
            lock = wait_for_lock(path, _CLAIM_TIMEOUT_S)
        except FileNotFoundError:
            continue  # the last member has just deleted the folder
        if lock is None:
            raise NameTaken(domain, _read(path, holder.name))
        lock.write(json.dumps(asdict(holder)))
        return lock


def _holder(folder: Path, name: str, kind: NameKind) -> NameHolder | None:
    path = _lock_path(folder, name, kind)
    if not path.exists():
        return None
    try:
        lock = try_lock(path)
    except OSError:
        return None
    if lock is None:
        return _read(path, name)
    lock.release(delete=True)
    return None


def _read(path: Path, name: str) -> NameHolder:
    """The content of a lock file; only the name if it cannot be read."""
    try:
        return NameHolder(**json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return NameHolder(name)


def _lock_path(folder: Path, name: str, kind: NameKind) -> Path:
    text = quote(name, safe="")
    if len(text) > _MAX_FILE_NAME:
        text = f"{text[:80]}-{sha256(name.encode()).hexdigest()[:16]}"
    return folder / f"{text}.{kind}"

"""The cgroups of a simulated host, in every hierarchy of this machine."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from tests.hosts.rig.requirements import cgroup_roots
from tests.support.waiting import wait_until

PREFIX = "robocomp-test-"


class HostCgroups:
    """`system` for the services of the host, `user` for the user's manager, which owns it."""

    def __init__(self, name: str, uid: int) -> None:
        self.folders = [root / f"{PREFIX}{os.getpid()}-{name}" for root in cgroup_roots()]
        for folder in self.folders:
            folder.mkdir()
            (folder / "system").mkdir()
            user = folder / "user"
            user.mkdir()
            for path in (user, *user.iterdir()):
                os.chown(path, uid, uid)

    def remove(self) -> None:
        """Remove all of them, when their processes have gone."""
        for folder in self.folders:
            wait_until(lambda folder=folder: _remove_tree(folder), f"cgroup {folder} is in use")


def _remove_tree(folder: Path) -> bool:
    for path, _, _ in os.walk(folder, topdown=False):
        with contextlib.suppress(OSError):
            os.rmdir(path)  # noqa: PTH106 - os.walk gives texts
    return not folder.exists()


def remove_stale_cgroups() -> None:
    """Remove what runs have left whose process was killed."""
    for root in cgroup_roots():
        for folder in root.glob(f"{PREFIX}*"):
            pid = folder.name.removeprefix(PREFIX).split("-")[0]
            if not Path("/proc", pid).exists():
                _remove_tree(folder)

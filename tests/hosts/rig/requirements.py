"""What simulated hosts need of this machine. In: nothing. Out: what is missing, by name."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

PROGRAMS = ("sshd", "systemctl", "ip", "unshare", "nsenter", "setpriv", "cc")
"""Programs; `tests/hosts/install.sh` installs their packages."""
CGROUP_ROOTS = ("/sys/fs/cgroup/systemd", "/sys/fs/cgroup/unified", "/sys/fs/cgroup")
SEARCH_PATH = os.pathsep.join(
    (os.environ.get("PATH", ""), "/usr/sbin", "/sbin", "/usr/bin", "/bin")
)


def systemd_program() -> str:
    """The path of systemd; empty if it is not installed."""
    candidates = ("/lib/systemd/systemd", "/usr/lib/systemd/systemd")
    return next((path for path in candidates if Path(path).exists()), "")


def cgroup_roots() -> list[Path]:
    """The roots of the cgroup hierarchies that systemd uses."""
    return [Path(root) for root in CGROUP_ROOTS if Path(root, "cgroup.procs").exists()]


def missing_requirement() -> str:
    """Why hosts cannot be simulated here; empty if they can."""
    if sys.platform != "linux":
        return "hosts need Linux namespaces"
    if os.geteuid() != 0:
        return "hosts need root: namespaces, mounts and cgroups"
    missing = [name for name in PROGRAMS if not shutil.which(name, path=SEARCH_PATH)]
    if not systemd_program():
        missing.append("systemd")
    if missing:
        return f"not installed: {', '.join(missing)}; tests/hosts/install.sh installs them"
    if not any(os.access(root, os.W_OK) for root in cgroup_roots()):
        return "no writable cgroup hierarchy"
    return ""

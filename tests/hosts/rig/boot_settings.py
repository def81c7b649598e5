"""What a simulated host is when it boots."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BootSettings:
    """What `boot.py` reads. `visible`: folders of this machine that the host sees, too."""

    name: str
    user: str
    uid: int
    files: str
    home: str
    cgroups: list[str]
    systemd: str
    visible: list[str]
    hidden: list[str]
    manager: bool = True
    linger: bool = True
    sshd: bool = True
    disk_bytes: int = 0

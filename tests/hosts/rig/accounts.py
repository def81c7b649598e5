"""The files of a simulated host: accounts, names, keys, and the settings of sshd."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

ROOT_ACCOUNTS = (
    "root:x:0:0:root:/root:/bin/bash",
    "nobody:x:65534:65534:nobody:/nonexistent:/usr/sbin/nologin",
    "sshd:x:100:65534::/run/sshd:/usr/sbin/nologin",
    "messagebus:x:101:101::/nonexistent:/usr/sbin/nologin",
)


def write_accounts(files: Path, user: str, uid: int) -> None:
    """The files of /etc that a host has of its own: one unprivileged user."""
    etc = files / "etc"
    accounts = (*ROOT_ACCOUNTS, f"{user}:x:{uid}:{uid}::/home/{user}:/bin/bash")
    groups = ("root:x:0:", "nogroup:x:65534:", "messagebus:x:101:", f"{user}:x:{uid}:")
    shadow = [f"{account.split(':')[0]}:*:19000:0:99999:7:::" for account in accounts]
    texts = {"passwd": accounts, "group": groups, "shadow": shadow, "resolv.conf": ()}
    texts["hosts"] = ("127.0.0.1 localhost",)
    for name, lines in texts.items():
        (etc / name).write_text("".join(f"{line}\n" for line in lines), "utf-8")
    (etc / "shadow").chmod(0o600)


def make_key(path: Path, comment: str) -> None:
    """An Ed25519 key pair: `path` and `path.pub`."""
    path.unlink(missing_ok=True)
    path.with_name(f"{path.name}.pub").unlink(missing_ok=True)
    command = ("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", comment, "-f", str(path))
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL)


def make_host_key(files: Path) -> None:
    """The host key of sshd."""
    make_key(files / "etc/ssh_host_ed25519_key", files.name)


def read_host_key(files: Path) -> str:
    """The public host key, as in the file."""
    return (files / "etc/ssh_host_ed25519_key.pub").read_text("ascii").strip()


def write_sshd_config(
    files: Path, user: str, extra: Sequence[str] = (), *, sftp: bool = True
) -> None:
    """The settings of sshd: keys only, one user. For each keyword the first line counts."""
    lines = (
        *extra,
        "Port 22",
        "ListenAddress 0.0.0.0",
        "HostKey /run/host/etc/ssh_host_ed25519_key",
        "PidFile /run/sshd.pid",
        "UsePAM no",
        "PasswordAuthentication no",
        "KbdInteractiveAuthentication no",
        "AuthorizedKeysFile .ssh/authorized_keys",
        "PermitRootLogin no",
        f"AllowUsers {user}",
        "MaxStartups 100",
        "UseDNS no",
        "PrintMotd no",
        *(["Subsystem sftp internal-sftp"] if sftp else ()),
    )
    (files / "etc/sshd_config").write_text("".join(f"{line}\n" for line in lines), "utf-8")


def authorize(home: Path, uid: int, public_key: str) -> None:
    """Let the owner of `public_key` log in."""
    ssh = home / ".ssh"
    ssh.mkdir(mode=0o700, exist_ok=True)
    keys = ssh / "authorized_keys"
    with keys.open("a", encoding="ascii") as file:
        file.write(f"{public_key.strip()}\n")
    keys.chmod(0o600)
    for path in (home, ssh, keys):
        os.chown(path, uid, uid)

"""The first process of a simulated host: mounts its file system, starts its services, reaps.

In: the path of a JSON file (`BootSettings` in `machine.py`); the process is PID 1 of its own PID,
mount, network, UTS and IPC namespaces. Out: lines on standard output: `namespaces`, then `ready`.
It ends with the host: when it is killed, the kernel kills every process of the host.

Uses the standard library only, so that it starts fast (`python -S -E`).
"""

from __future__ import annotations

import ctypes
import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

MS_NOSUID, MS_NODEV, MS_NOEXEC, MS_BIND, MS_MOVE, MS_REC = 2, 4, 8, 0x1000, 0x2000, 0x4000
MASKED = ("/tmp", "/var/tmp", "/home", "/root", "/dev/shm", "/var/lib/systemd")
"""Folders of the machine that a host has empty and to itself; /run is another."""
SHARED_FILES = "/run/host"
"""Where the files of the test's folder appear on the host."""
MANAGER_TIMEOUT_S = 60.0

_libc = ctypes.CDLL(None, use_errno=True)


def mount(source: str, target: str, kind: str = "", flags: int = 0, options: str = "") -> None:
    """mount(2). Raises `OSError`."""
    arguments = [text.encode() or None for text in (source, target, kind)]
    if _libc.mount(*arguments, flags, options.encode()):
        number = ctypes.get_errno()
        raise OSError(number, f"mount {source} on {target}: {os.strerror(number)}")


def bind(source: str, target: str) -> None:
    """Show `source` at `target`."""
    mount(source, target, flags=MS_BIND | MS_REC)


def mount_file_system(settings: dict[str, Any]) -> None:
    """Give the host its own /run, /tmp, /home, accounts and process list."""
    mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC)
    visible = [Path(path).resolve() for path in settings["visible"]]
    # The folders are opened first: the masks hide them.
    opened = [os.open(path, os.O_PATH) for path in visible]
    files = os.open(settings["files"], os.O_PATH)
    home = os.open(settings["home"], os.O_PATH)
    mount("tmpfs", "/run", "tmpfs", MS_NOSUID | MS_NODEV, "mode=755")
    for folder in MASKED:
        mode = "1777" if "tmp" in folder or "shm" in folder else "755"
        mount("tmpfs", folder, "tmpfs", MS_NOSUID | MS_NODEV, f"mode={mode}")
    for path, descriptor in zip(visible, opened, strict=True):
        if any(path.is_relative_to(folder) for folder in (*MASKED, "/run")):
            path.mkdir(parents=True)
            bind(f"/proc/self/fd/{descriptor}", str(path))
    Path(SHARED_FILES).mkdir()
    bind(f"/proc/self/fd/{files}", SHARED_FILES)
    mount_home(settings, home)
    for descriptor in (*opened, files, home):
        os.close(descriptor)
    for name in ("passwd", "group", "shadow", "hosts", "resolv.conf"):
        if Path("/etc", name).exists():
            bind(f"{SHARED_FILES}/etc/{name}", f"/etc/{name}")
    for path in settings["hidden"]:
        bind("/dev/null", path)


def mount_home(settings: dict[str, Any], source: int) -> None:
    """The user's home: a folder of the test, or a small file system with a copy of it."""
    folder = f"/proc/self/fd/{source}"
    target = Path("/home", settings["user"])
    target.mkdir()
    if not settings["disk_bytes"]:
        bind(folder, str(target))
        return
    owner = f"uid={settings['uid']},gid={settings['uid']},mode=700"
    mount(
        "tmpfs",
        str(target),
        "tmpfs",
        MS_NOSUID | MS_NODEV,
        f"size={settings['disk_bytes']},{owner}",
    )
    subprocess.run(["cp", "-a", f"{folder}/.", str(target)], check=True, pass_fds=[source])


def make_runtime_folders(settings: dict[str, Any]) -> Path:
    """What boot and login make in /run; returns the user's runtime folder."""
    for folder in ("/run/sshd", "/run/lock", "/run/systemd/system"):
        Path(folder).mkdir(parents=True, exist_ok=True)
    linger = Path("/var/lib/systemd/linger")
    linger.mkdir()
    if settings["linger"]:
        (linger / settings["user"]).touch()
    runtime = Path("/run/user", str(settings["uid"]))
    runtime.mkdir(parents=True)
    if not settings["manager"]:
        runtime.rmdir()
        return runtime
    os.chown(runtime, settings["uid"], settings["uid"])
    runtime.chmod(0o700)
    return runtime


def join_cgroup(folders: list[str], name: str) -> None:
    """Move this process into the child `name` of each cgroup."""
    for folder in folders:
        Path(folder, name, "cgroup.procs").write_text("0", encoding="utf-8")


def start_manager(settings: dict[str, Any], runtime: Path) -> None:
    """Start `systemd --user`, and wait until it takes commands."""
    uid = str(settings["uid"])
    environment = {
        "HOME": f"/home/{settings['user']}",
        "USER": settings["user"],
        "LOGNAME": settings["user"],
        "SHELL": "/bin/bash",
        "PATH": "/usr/local/bin:/usr/bin:/bin",
        "XDG_RUNTIME_DIR": str(runtime),
        "DBUS_SESSION_BUS_ADDRESS": f"unix:path={runtime}/bus",
    }
    join_cgroup(settings["cgroups"], "user")
    with open("/run/host/manager.log", "ab") as log:  # noqa: PTH123 - no user of the path otherwise
        manager = subprocess.Popen(
            [
                "setpriv",
                f"--reuid={uid}",
                f"--regid={uid}",
                "--init-groups",
                settings["systemd"],
                "--user",
            ],
            env=environment,
            cwd=environment["HOME"],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
    join_cgroup(settings["cgroups"], "system")
    deadline = time.monotonic() + MANAGER_TIMEOUT_S
    while not (runtime / "systemd/private").exists():
        if manager.poll() is not None or time.monotonic() > deadline:
            log_text = Path("/run/host/manager.log").read_text("utf-8", "replace")
            sys.exit(f"systemd --user did not start:\n{log_text}")
        time.sleep(0.002)


def start_sshd() -> None:
    """Start OpenSSH's server; return when it listens."""
    with open("/run/host/sshd.log", "ab") as log:  # noqa: PTH123
        subprocess.Popen(
            ["/usr/sbin/sshd", "-D", "-e", "-f", "/run/host/etc/sshd_config"],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
    deadline = time.monotonic() + MANAGER_TIMEOUT_S
    while not Path("/run/sshd.pid").exists():
        if time.monotonic() > deadline:
            sys.exit(f"sshd did not start:\n{Path('/run/host/sshd.log').read_text('utf-8')}")
        time.sleep(0.002)


def main() -> None:
    """Boot, then reap orphans until the host is killed."""
    settings = json.loads(Path(sys.argv[1]).read_text("utf-8"))
    print("namespaces", flush=True)
    socket.sethostname(settings["name"])
    mount_file_system(settings)
    os.chdir("/")
    runtime = make_runtime_folders(settings)
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    join_cgroup(settings["cgroups"], "system")
    if settings["sshd"]:
        start_sshd()
    if settings["manager"]:
        start_manager(settings, runtime)
    print("ready", flush=True)
    while True:
        try:
            os.wait()
        except ChildProcessError:
            time.sleep(0.2)


if __name__ == "__main__":
    main()

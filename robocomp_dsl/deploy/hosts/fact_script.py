"""Runs on a host: prints what the host is, then its time for each line of standard input.

In: the name of a deployment as an argument. Out: a line of JSON after `robocomp-facts`, then one
time in ns since 1970 per line. Only the standard library of Python 3.6, so that a host with an old
Python is reported as that; no import of this project, because rcdeploy sends the text of this file.
"""

import getpass
import glob
import json
import os
import platform
import re
import subprocess
import sys
import time
from typing import Any, Dict, List, Tuple

MARK = "robocomp-facts "
TIMEOUT_S = 10.0
PYTHON = re.compile(r"python3(\.\d+)?")
VERSION = "import sys; print('.'.join(map(str, sys.version_info[:3])))"


def output(*command: str) -> Tuple[int, str, str]:
    """Exit code, output and errors of a command; 127 if it does not exist."""
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            timeout=TIMEOUT_S,
            check=False,
        )
    except (OSError, subprocess.SubprocessError) as error:
        return 127, "", str(error)
    return done.returncode, decode(done.stdout), decode(done.stderr)


def decode(data: bytes) -> str:
    """`data` as a text without white space around it."""
    return data.decode("utf-8", "replace").strip()


def pythons() -> List[Dict[str, str]]:
    """The Pythons in PATH, each once, in the order of PATH."""
    found: Dict[str, Dict[str, str]] = {}
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    for folder in [*folders, os.path.expanduser("~/.local/bin")]:
        for path in sorted(glob.glob(os.path.join(glob.escape(folder), "python3*"))):
            real = os.path.realpath(path)
            if real in found or not PYTHON.fullmatch(os.path.basename(path)):
                continue
            if os.path.isfile(path) and os.access(path, os.X_OK):
                code, version, _ = output(path, "-I", "-S", "-c", VERSION)
                if code == 0:
                    found[real] = {"path": path, "version": version}
    return list(found.values())


def glibc() -> str:
    """The version of the GNU C library; empty with another library."""
    try:
        return (os.confstr("CS_GNU_LIBC_VERSION") or "").split(" ")[-1]
    except (ValueError, OSError):
        return ""


def systemd() -> Dict[str, Any]:
    """Version of systemd, state of the user's manager, controllers that it may use."""
    code, text, _ = output("systemctl", "--version")
    match = re.match(r"systemd (\d+)", text) if code == 0 else None
    if not match:
        return {"version": 0, "manager": "", "problem": "", "controllers": []}
    # Exit code 1 is that of every state but `running`.
    _, manager, problem = output("systemctl", "--user", "is-system-running")
    if manager in ("", "offline", "unknown"):
        manager = ""
    return {
        "version": int(match.group(1)),
        "manager": manager,
        "problem": "" if manager else problem.split("\n")[0],
        "controllers": controllers() if manager else [],
    }


def controllers() -> List[str]:
    """The controllers of cgroups that the user's manager may set: `memory`, `cpu`."""
    _, group, _ = output("systemctl", "--user", "show", "--property=ControlGroup", "--value")
    for root in ("/sys/fs/cgroup", "/sys/fs/cgroup/unified"):
        try:
            with open(root + group + "/cgroup.controllers") as file:
                return file.read().split()
        except OSError:
            continue
    return []


def lingers(user: str) -> bool:
    """Whether the user's manager runs without a login."""
    return os.path.exists("/var/lib/systemd/linger/" + user)


def memory() -> Dict[str, int]:
    """Total and available memory in bytes."""
    try:
        with open("/proc/meminfo") as file:
            fields = dict(line.split(":", 1) for line in file if ":" in line)
        return {
            "total": int(fields["MemTotal"].split()[0]) * 1024,
            "available": int(fields["MemAvailable"].split()[0]) * 1024,
        }
    except (OSError, KeyError, ValueError):
        return {"total": 0, "available": 0}


def disk() -> Dict[str, int]:
    """Size, free bytes and free files of the home."""
    status = os.statvfs(os.path.expanduser("~"))
    return {
        "size": status.f_blocks * status.f_frsize,
        "free": status.f_bavail * status.f_frsize,
        "files": status.f_favail if status.f_files else -1,
    }


def writable() -> bool:
    """Whether the user may write in the home."""
    return os.access(os.path.expanduser("~"), os.W_OK | os.X_OK)


def lock(deployment: str) -> Dict[str, Any]:
    """Who changes the deployment now, and for how long; nothing is locked to find out."""
    path = os.path.expanduser("~/.local/share/robocomp/" + deployment + "/lock")
    try:
        status = os.stat(path)
        with open("/proc/locks") as file:
            locks = file.read()
        place = "{:02x}:{:02x}:{}".format(
            os.major(status.st_dev), os.minor(status.st_dev), status.st_ino
        )
        if not re.search(r" FLOCK .* " + re.escape(place) + r"\s", locks):
            return {}
        with open(path, encoding="utf-8", errors="replace") as file:
            holder = file.read(1000)
    except OSError:
        return {}
    return {"holder": holder or "another deployer", "age": max(time.time() - status.st_mtime, 0)}


def read_line(path: str) -> str:
    """The first line of a file; empty if there is none."""
    try:
        with open(path) as file:
            return file.readline().strip()
    except OSError:
        return ""


def facts(deployment: str) -> Dict[str, Any]:
    """All that the deployer wants to know."""
    user = getpass.getuser()
    return {
        "hostname": platform.node(),
        "user": user,
        "uid": os.getuid(),
        "home": os.path.expanduser("~"),
        "boot": read_line("/proc/sys/kernel/random/boot_id"),
        "machine": platform.machine(),
        "system": platform.system(),
        "glibc": glibc(),
        "pythons": pythons(),
        "systemd": systemd(),
        "linger": lingers(user),
        "cpus": os.cpu_count() or 1,
        "load": list(os.getloadavg()),
        "memory": memory(),
        "disk": disk(),
        "writable": writable(),
        "lock": lock(deployment) if deployment else {},
    }


def main() -> None:
    """Print the facts, then the time when it is requested."""
    print(MARK + json.dumps(facts(sys.argv[1] if len(sys.argv) > 1 else "")), flush=True)
    while sys.stdin.buffer.readline():
        print(int(time.time() * 1e9), flush=True)


if __name__ == "__main__":
    main()

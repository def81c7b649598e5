"""Runs on a host, for one deployer: reports, starts and stops the units of a deployment.

In: JSON lines on standard input, the deployment's folder and unit prefixes as arguments. Out: JSON
lines: `{"reply": …}` to each request in turn, and `{"states": …}` when watched units change. Ends
with its input, or when a deployer that holds the lock stays silent. Only the standard library of
Python 3.8, no import of this project: rcdeploy sends the text of this file.
"""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import re
import select
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

PROPERTIES = (
    "Id,LoadState,ActiveState,SubState,Result,MainPID,NRestarts,ExecMainCode,ExecMainStatus,"
    "StatusText,ActiveEnterTimestampMonotonic,InactiveEnterTimestampMonotonic,Job,"
    "InactiveExitTimestampMonotonic,StartLimitBurst"
)
# A manager that reads its units again forgets how often they were started lately.
NO_RELOAD, NO_BLOCK = ["--no-reload"], ["--no-block"]
OPTIONS = {"start": NO_BLOCK, "restart": NO_BLOCK, "enable": NO_RELOAD, "disable": NO_RELOAD}
UNITS = Path(".config/systemd/user")
PERIOD_S = 0.1
SILENCE_S = 30.0
"""A deployer that holds the lock sends something more often."""
CPU_SAMPLE_S = 0.2
TICKS = os.sysconf("SC_CLK_TCK")
PAGE = os.sysconf("SC_PAGE_SIZE")
REVISION = b"ROBOCOMP_UNIT="
DRAFT = re.compile(r"\.[0-9a-f]{8}~$")
"""A file that is not yet complete; the deployer renames it at the end."""


def systemctl(*words: str) -> tuple[int, str, str]:
    """Output of `systemctl --user`; its exit code and errors."""
    command = ["systemctl", "--user", "--no-pager", *words]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False)  # noqa: S603
    return done.returncode, done.stdout.decode("utf-8", "replace"), done.stderr.decode().strip()


def show(units: list[str]) -> dict[str, dict[str, Any]]:
    """The properties of units, by name."""
    if not units:
        return {}
    code, text, error = systemctl("show", "--property=" + PROPERTIES, "--", *units)
    if code:
        raise OSError(error or "systemctl show failed")
    blocks = [
        dict(line.split("=", 1) for line in block.splitlines()) for block in text.split("\n\n")
    ]
    return {block["Id"]: block for block in blocks if "Id" in block}


def read_text(path: str | Path) -> str | None:
    """The content of a file; None if there is none."""
    try:
        return Path(path).read_text("utf-8", "replace")
    except OSError:
        return None


def children_of(processes: dict[int, tuple[int, float, int]], pid: int) -> list[int]:
    """`pid` and its descendants."""
    found = [pid]
    for parent in found:
        found += [child for child, entry in processes.items() if entry[0] == parent]
    return found


def all_processes() -> dict[int, tuple[int, float, int]]:
    """Parent, CPU seconds and memory in bytes of each process of this user."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if folder.stat().st_uid != os.getuid():
                continue
            fields = (folder / "stat").read_text("ascii", "replace")
        except OSError:
            continue
        rest = fields.rpartition(")")[2].split()
        cpu = (int(rest[11]) + int(rest[12])) / TICKS
        found[int(folder.name)] = (int(rest[1]), cpu, int(rest[21]) * PAGE)
    return found


def revision_of(pid: int) -> str:
    """The revision of the unit with which a process was started; "" if unknown."""
    try:
        variables = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
    except OSError:
        return ""
    return next((v[len(REVISION) :].decode() for v in variables if v.startswith(REVISION)), "")


class Agent:
    """Answers the requests about one deployment."""

    def __init__(self, root: str, prefixes: list[str]) -> None:
        self.root = Path(root)
        self.prefixes = tuple(prefixes)
        self.watched: dict[str, Any] = {}
        self.operations: dict[str, int] = {}
        self.lock: int | None = None
        self.heard = time.monotonic()

    def unit_files(self) -> dict[str, str]:
        """The unit files of the deployment, by name."""
        try:
            names = sorted(path.name for path in UNITS.iterdir())
        except OSError:
            return {}
        return {
            name: text
            for name in names
            if name.startswith(self.prefixes) and not DRAFT.search(name)
            for text in [read_text(UNITS / name)]
            if text is not None
        }

    def report(self, usage: bool = False) -> dict[str, Any]:
        """What is deployed here, and what runs."""
        current = (read_text(self.root / "current") or "").strip()
        manifest = read_text(self.root / "versions" / (current + ".json")) if current else None
        files = self.unit_files()
        services = [name for name in files if name.endswith(".service")]
        states = show(services)
        first = all_processes() if usage else {}
        if usage and any(int(s.get("MainPID", 0)) for s in states.values()):
            time.sleep(CPU_SAMPLE_S)
            second = all_processes()
        else:
            second = first
        for state in states.values():
            pid = int(state.get("MainPID", 0))
            if pid:
                state["Revision"] = revision_of(pid)
                tree = children_of(second, pid) if usage else []
                state["Memory"] = sum(second[p][2] for p in tree if p in second)
                cpu = sum(second[p][1] - first[p][1] for p in tree if p in first and p in second)
                state["Cpu"] = cpu / CPU_SAMPLE_S
        return {
            "current": current,
            "versions": self.versions(),
            "manifest": manifest,
            "router": self.router_settings(),
            "units": files,
            "states": states,
            "monotonic": time.clock_gettime(time.CLOCK_MONOTONIC),
            "time": time.time(),
        }

    def router_settings(self) -> str:
        """The hash of the settings that the router has."""
        try:
            content = (self.root / "private" / "router.json").read_bytes()
        except OSError:
            return ""
        return hashlib.sha256(content).hexdigest()[:16]

    def versions(self) -> list[int]:
        """The numbers of the versions that are stored here."""
        try:
            names = [path.name for path in (self.root / "versions").iterdir()]
        except OSError:
            return []
        return sorted(int(m[1]) for m in (re.match(r"(\d+)\.json$", n) for n in names) if m)

    def acquire(self, who: str) -> dict[str, Any]:
        """Lock the deployment on this host; the holder, if that is another deployer."""
        self.root.mkdir(parents=True, exist_ok=True, mode=0o700)
        descriptor = os.open(str(self.root / "lock"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            holder = os.read(descriptor, 1000).decode("utf-8", "replace")
            os.close(descriptor)
            return {"holder": holder or "another deployer"}
        os.ftruncate(descriptor, 0)
        os.write(descriptor, who.encode())
        self.lock = descriptor
        self.remove_drafts()
        return {"holder": ""}

    def remove_drafts(self) -> None:
        """Remove what a deployer has left that was killed while it wrote."""
        for folder in (UNITS, self.root, self.root / "versions", self.root / "private"):
            with contextlib.suppress(OSError):
                for path in folder.iterdir():
                    own = folder != UNITS or path.name.startswith(self.prefixes)
                    if own and DRAFT.search(path.name):
                        path.unlink()

    def control(self, operation: str, units: list[str]) -> dict[str, Any]:
        """`systemctl VERB UNITS`; for long jobs without waiting."""
        for unit in units if operation in ("start", "stop", "restart") else ():
            self.operations[unit] = self.operations.get(unit, 0) + 1
            if unit in self.watched:
                self.watched[unit] = None
        code, _, error = systemctl(operation, *OPTIONS.get(operation, ()), "--", *units)
        return {"code": code, "error": error}

    def watch(self, units: list[str]) -> dict[str, Any]:
        """Report changes of these units from now on."""
        self.watched = dict.fromkeys(units)
        return {}

    def tail(self, component: str, size: int) -> dict[str, Any]:
        """The last bytes of a log file."""
        try:
            with (self.root / "logs" / (component + ".log")).open("rb") as log:
                end = log.seek(0, 2)
                log.seek(max(end - size, 0))
                return {"text": log.read().decode("utf-8", "replace")}
        except OSError:
            return {"text": ""}

    def folders(self, components: list[str]) -> dict[str, Any]:
        """Create the folders of logs."""
        (self.root / "logs").mkdir(parents=True, exist_ok=True, mode=0o700)
        for component in components:
            (self.root / "logs" / component).parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        return {}

    def remove(self, units: list[str]) -> dict[str, Any]:
        """Delete unit files."""
        for unit in units:
            if unit.startswith(self.prefixes) and "/" not in unit:
                with contextlib.suppress(FileNotFoundError):
                    (UNITS / unit).unlink()
        return {}

    def poll(self) -> None:
        """Send the states of watched units that have changed."""
        states = show(list(self.watched))
        changed = {u: dict(s) for u, s in states.items() if self.watched.get(u) != s}
        self.watched.update((unit, states[unit]) for unit in changed)
        for unit, state in changed.items():
            state["Operations"] = self.operations.get(unit, 0)
        if changed:
            send({"states": changed, "monotonic": time.clock_gettime(time.CLOCK_MONOTONIC)})


def send(message: dict[str, Any]) -> None:
    """Write one line."""
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


def main() -> None:
    """Answer requests until the input ends."""
    agent = Agent(sys.argv[1], sys.argv[2:])
    handlers: dict[str, Any] = {
        "report": agent.report,
        "acquire": agent.acquire,
        "control": agent.control,
        "watch": agent.watch,
        "tail": agent.tail,
        "folders": agent.folders,
        "remove": agent.remove,
        "ping": dict,
    }
    rest = b""
    while True:
        readable = select.select([0], [], [], PERIOD_S if agent.watched else 1.0)[0]
        if readable:
            data = os.read(0, 65536)
            if not data:
                return
            agent.heard = time.monotonic()
            *lines, rest = (rest + data).split(b"\n")
            for line in lines:
                request = json.loads(line.decode())
                try:
                    send({"reply": handlers[request.pop("verb")](**request)})
                except OSError as error:
                    send({"error": str(error)})
        elif agent.lock is not None and time.monotonic() - agent.heard > SILENCE_S:
            return
        if agent.watched:
            try:
                agent.poll()
            except OSError as error:
                send({"problem": str(error)})


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        os._exit(0)

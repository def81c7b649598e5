"""What a host is: Python, systemd, space, load, clock. In: a connection. Out: `HostFacts`."""

from __future__ import annotations

import asyncio
import json
import shlex
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.deploy.hosts.address import describe_host
from robocomp_dsl.deploy.hosts.clock_offset import ClockOffset, measure_offset
from robocomp_dsl.deploy.hosts.connection import HostConnection, HostProcess
from robocomp_dsl.deploy.hosts.errors import HostError, HostRefused, HostTimeout

SCRIPT = Path(__file__).with_name("fact_script.py")
MARK = b"robocomp-facts "
MIN_PYTHON = (3, 11)
NEWEST_PYTHON = 15
"""Names `python3.11` to `python3.15` are tried, where no `python3` is."""
FACTS_TIMEOUT_S = 60.0
_NOT_FOUND = 127


@dataclass(frozen=True, slots=True)
class HostPython:
    """A Python of a host; `version` such as (3, 11, 2)."""

    path: str
    version: tuple[int, ...]

    @property
    def is_suitable(self) -> bool:
        """Whether components run with it."""
        return self.version >= MIN_PYTHON

    def __str__(self) -> str:
        return f"{'.'.join(map(str, self.version))} ({self.path})"


@dataclass(frozen=True, slots=True)
class HostFacts:
    """A host when it was asked.

    `machine` as from uname (`x86_64`); `glibc` "": another C library. `systemd` 0: not installed.
    `manager` is the state of the user's manager, such as `running`; "" if it does not run, with the
    `manager_problem`. `controllers`: those of cgroups that the manager may set. Bytes of the home's
    file system and of memory. `load`: averages of 1, 5 and 15 minutes. `lock_holder` "": nobody
    changes the deployment, otherwise since `lock_age_s`. `boot` changes with each boot.
    """

    hostname: str
    user: str
    uid: int
    home: str
    boot: str
    machine: str
    system: str
    glibc: str
    pythons: tuple[HostPython, ...]
    systemd: int
    manager: str
    manager_problem: str
    controllers: tuple[str, ...]
    linger: bool
    cpus: int
    load: tuple[float, float, float]
    memory_bytes: int
    memory_available_bytes: int
    disk_bytes: int
    free_bytes: int
    home_writable: bool
    lock_holder: str
    lock_age_s: float
    clock: ClockOffset

    @property
    def python(self) -> HostPython | None:
        """The Python for components: the first suitable one of PATH."""
        return next((python for python in self.pythons if python.is_suitable), None)

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self)


def parse_facts(data: Mapping[str, Any], clock: ClockOffset) -> HostFacts:
    """The facts that the script printed. Raises `LookupError`, `TypeError` or `ValueError`."""
    systemd, lock, memory = data["systemd"], data["lock"], data["memory"]
    load = tuple(map(float, data["load"]))
    pythons = (
        HostPython(python["path"], tuple(map(int, python["version"].split("."))))
        for python in data["pythons"]
    )
    return HostFacts(
        **{name: str(data[name]) for name in ("hostname", "user", "home", "boot", "machine")},
        system=data["system"],
        uid=data["uid"],
        glibc=data["glibc"],
        pythons=tuple(pythons),
        systemd=systemd["version"],
        manager=systemd["manager"],
        manager_problem=systemd["problem"],
        controllers=tuple(systemd["controllers"]),
        linger=data["linger"],
        cpus=data["cpus"],
        load=(load[0], load[1], load[2]),
        memory_bytes=memory["total"],
        memory_available_bytes=memory["available"],
        disk_bytes=data["disk"]["size"],
        free_bytes=data["disk"]["free"] if data["disk"]["files"] else 0,
        home_writable=data["writable"],
        lock_holder=lock.get("holder", ""),
        lock_age_s=float(lock.get("age", 0.0)),
        clock=clock,
    )


def script_command(deployment: str) -> list[str]:
    """The command that runs the script with the first Python 3 of the host."""
    names = ["python3", *(f"python3.{n}" for n in range(MIN_PYTHON[1], NEWEST_PYTHON + 1))]
    search = (
        f"for python in {shlex.join(names)}; do"
        ' command -v "$python" >/dev/null 2>&1 && exec "$python" -c "$@"; done;'
        f" exit {_NOT_FOUND}"
    )
    return ["sh", "-c", search, "sh", SCRIPT.read_text("utf-8"), deployment]


async def fetch_facts(connection: HostConnection, deployment: str = "") -> HostFacts:
    """Ask the host of `connection`, also who changes `deployment` there. Raises `HostError`."""
    try:
        async with asyncio.timeout(FACTS_TIMEOUT_S):
            process = await connection.start(script_command(deployment))
            return await _fetch(connection, process)
    except TimeoutError:
        text = f"{describe_host(connection.host)}: no report within {FACTS_TIMEOUT_S:g} s"
        raise HostTimeout(text, "check the load of the host") from None


async def _fetch(connection: HostConnection, process: HostProcess) -> HostFacts:
    line, printed = b" ", b""
    while line and not line.startswith(MARK):  # a login script may print something first
        printed = line.strip() or printed
        line = await process.readline()
    if not line:
        raise await _no_report(connection, process, printed)
    try:
        clock = await measure_offset(process)
        facts = parse_facts(json.loads(line.removeprefix(MARK)), clock)
    except (LookupError, TypeError, ValueError) as error:
        text = f"{describe_host(connection.host)}: its report is not understood: {error!r}"
        raise HostRefused(text) from None
    await process.close()
    return facts


async def _no_report(connection: HostConnection, process: HostProcess, printed: bytes) -> HostError:
    """Why there are no facts; `printed` is the last line of the output."""
    result = await process.close()
    name = describe_host(connection.host)
    required = ".".join(map(str, MIN_PYTHON))
    if result.code == _NOT_FOUND:
        remedy = f"install Python {required} or newer on the host, as `python3` in PATH"
        return HostRefused(f"{name}: there is no Python", remedy, codes.PYTHON)
    lines = result.error.splitlines() or printed.decode("utf-8", "replace").splitlines()
    reason = lines[-1] if lines else f"exit code {result.code}"
    return HostRefused(f"{name}: Python does not run there: {reason}", "", codes.PYTHON)

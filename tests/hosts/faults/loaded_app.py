"""A deployment under load on simulated hosts, and what systemd and its journals say about it."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.units import names
from tests.hosts.engine.hosted_app import HostedApp
from tests.hosts.faults import load_components
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.support.waiting import wait_until

UNDER_LOAD = ("ledger", "caller", "source", "sink")
KILL = (
    "import os, sys, time\nprint(time.monotonic())\nfor pid in sys.argv[1:]: os.kill(int(pid), 9)\n"
)
LOOK_S = 0.1
PROPERTIES = "MainPID,ActiveState,SubState,Result,NRestarts,ActiveEnterTimestampMonotonic"


@dataclass(frozen=True)
class Unit:
    """A unit as systemd shows it; `ready_at` by the monotonic clock [s]."""

    pid: int
    active: str
    sub: str
    result: str
    restarts: int
    ready_at: float


class LoadedApp(HostedApp):
    """The components of `load_components` on hosts; `places` maps component to host."""

    name = "load"

    def __init__(self, folder: Path, hosts: Hosts) -> None:
        super().__init__(folder, hosts)
        self.places: dict[str, str] = {}

    def describe(self, components: dict[str, str], more: str = "") -> None:
        """Write the DDSL file, and make its keys.

        `components`: name → host and, after a space, statements.
        """
        self.places = {name: text.split(" ")[0] for name, text in components.items()}
        statements = "".join(
            f"    component {name} on {host} {{ ready within 100 s; {extra} }};\n"
            for name, (host, _, extra) in ((n, t.partition(" ")) for n, t in components.items())
        )
        declared = "".join(
            f'    host {host} {{ address "{h.address}"; user {h.user}; }};\n'
            for host, h in self.hosts.by_name.items()
            if host in self.places.values()
        )
        imports = "".join(f'import "{name}/{name}.cdsl";\n' for name in components)
        self.path.write_text(
            f"{imports}Deployment {self.name}\n{{\n{declared}{statements}{more}}};\n"
        )
        self.make_keys()

    def host_of(self, component: str) -> SimulatedHost:
        return self.hosts.by_name[self.places[component]]

    def unit(self, component: str) -> Unit:
        """What systemd says about a component."""
        name = names.service_name(self.name, component)
        return show_unit(self.host_of(component), name)

    def units(self) -> dict[str, Unit]:
        return {component: self.unit(component) for component in self.places}

    def unit_pids(self) -> dict[str, int]:
        return {name: unit.pid for name, unit in self.units().items()}

    @contextmanager
    def held(self, component: str) -> Iterator[None]:
        """Meanwhile no new process of `ledger` or `caller` becomes ready."""
        path = journals_of(self.host_of(component)) / f"{component}.hold"
        path.touch()
        try:
            yield
        finally:
            path.unlink()

    def kill(self, component: str) -> float:
        """SIGKILL; returns the time by the monotonic clock [s]."""
        return kill_unit(self.host_of(component), self.unit(component).pid)

    def ready_again(self, component: str, since: float) -> float:
        """Wait until a component that ended at `since` is ready; the time [s] that took.

        The time is that of systemd. Looking seldom leaves the processors to the components.
        """

        def ready_time() -> float:
            unit = self.unit(component)
            if unit.active == "active" and unit.ready_at > since:
                return unit.ready_at
            time.sleep(LOOK_S)
            return 0.0

        return wait_until(ready_time, lambda: f"{component}: {self.unit(component)}") - since

    def journal(self, component: str, name: str) -> list[tuple[str, int, float]]:
        """The lines of a journal: process, number, time."""
        path = journals_of(self.host_of(component)) / name
        lines = path.read_text("ascii").splitlines() if path.exists() else []
        fields = (line.split() for line in lines)
        return [(process, int(number), float(moment)) for process, number, moment in fields]

    def first_after(self, component: str, name: str, since: float) -> float:
        """Wait for an entry of a journal after `since`; its time [s]."""
        return wait_until(
            lambda: next((t for _, _, t in self.journal(component, name) if t > since), 0.0),
            lambda: f"nothing in the journal {name} of {component}\n{self.last_lines()}",
        )

    def row(self, component: str) -> ProcessStatus:
        """What `rcdeploy status` says about a component."""
        return next(r for r in self.engine(self.name).status().rows if r.name == component)

    def log(self, component: str) -> str:
        """The log file of a component."""
        path = f"{names.root_folder(self.name)}/{names.log_file(component)}"
        return (self.host_of(component).home / path).read_text("utf-8")

    def last_lines(self, count: int = 20) -> str:
        """The last log lines of all processes and routers, for messages of tests."""
        folders = [
            self.hosts.by_name[host].home / names.root_folder(self.name) / "logs"
            for host in sorted(set(self.places.values()))
        ]
        return "\n".join(
            f"{path.stem}: {line}"
            for folder in folders
            for path in sorted(folder.glob("*.log"))
            for line in path.read_text("utf-8", "replace").splitlines()[-count:]
        )

    def logged(self, component: str, text: str, since: float) -> list[float]:
        """The times of the log lines after `since` that contain `text` [s since 1970]."""
        lines = [line for line in self.log(component).splitlines() if text in line]
        times = (float(json.loads(line)["time"]) for line in lines)
        return [moment for moment in times if moment > since]

    def lost_calls(self) -> set[tuple[str, int]]:
        """Calls that were acknowledged and not executed."""
        acknowledged = {entry[:2] for entry in self.journal("caller", "acknowledged")}
        return acknowledged - {entry[:2] for entry in self.journal("ledger", "executed")}

    def doubled_calls(self) -> int:
        """How often a call was executed again."""
        executed = [entry[:2] for entry in self.journal("ledger", "executed")]
        return len(executed) - len(set(executed))


def journals_of(host: SimulatedHost) -> Path:
    """The folder of the journals, which a full disk and a power failure spare."""
    return Path(host.settings.files, "journals")


def kill_unit(host: SimulatedHost, pid: int) -> float:
    """SIGKILL to a process of a host; returns the time by the monotonic clock [s]."""
    assert pid
    return float(host.run(["python3", "-c", KILL, str(pid)]).stdout)


def show_unit(host: SimulatedHost, unit: str) -> Unit:
    """What systemd says about a unit."""
    text = host.systemctl("show", f"--property={PROPERTIES}", "--", unit)
    fields = dict(line.split("=", 1) for line in text.splitlines())
    return Unit(
        int(fields["MainPID"]),
        fields["ActiveState"],
        fields["SubState"],
        fields["Result"],
        int(fields["NRestarts"]),
        int(fields["ActiveEnterTimestampMonotonic"]) / 1e6,
    )


def make_loaded_app(folder: Path, hosts: Hosts) -> LoadedApp:
    """Generate the components in `folder`."""
    load_components.build(folder)
    hosts.trust()
    return LoadedApp(folder, hosts)


def percentile(values: Iterable[float], share: float) -> float:
    """The smallest value that is not below `share` of all values."""
    ordered = sorted(values)
    return ordered[math.ceil(share * len(ordered)) - 1]

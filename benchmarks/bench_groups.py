"""The same group as two processes, over zenoh and over local, and in one process, in turns.

All three run at the same time; those that are not measured are idle. Delays of commands and
publications are from the sender to the handler, of one message per millisecond.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.bridge_processes import cpu_seconds
from benchmarks.group_components import write_components
from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"
VARIANTS = ("zenoh", "local", "inprocess_")
KINDS = {"query": 200, "command": 50, "publication": 50}
ROUNDS = 30
CPU_QUERIES = 5000
TIMEOUT_S = 60.0


def rcdeploy(*arguments: str) -> list[str]:
    """The command line of rcdeploy."""
    return [sys.executable, "-c", PROGRAM, *arguments]


@contextmanager
def deployment(file: Path, domain: str) -> Iterator[dict[str, list[int]]]:
    """Run a deployment; yields the processes of each variant."""
    command = rcdeploy("up", str(file), "--domain", domain, "-I", str(file.parent))
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as started:
        try:
            assert started.stdout
            for line in started.stdout:
                if "components are ready" in line:
                    break
            else:
                raise RuntimeError("the deployment did not start")
            status = rcdeploy("status", "bench", "--format", "json")
            found = subprocess.run(status, check=False, capture_output=True, text=True)
            rows = json.loads(found.stdout)["components"]
            yield {
                variant: [row["pid"] for row in rows if row["name"].split("-")[0] == variant]
                for variant in VARIANTS
            }
        finally:
            started.terminate()
            started.communicate()


def cpu(pids: list[int]) -> float:
    """The CPU time of processes so far in s."""
    return sum(map(cpu_seconds, pids))


def memory(pids: list[int]) -> float:
    """The memory of processes in MB; what they share counts in proportion."""
    lines = [Path(f"/proc/{pid}/smaps_rollup").read_text() for pid in pids]
    kilobytes = [int(text.split("\nPss:")[1].split()[0]) for text in lines]
    return sum(kilobytes) / 1000


def run() -> list[dict[str, Any]]:
    """All figures."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_RUNTIME_DIR"] = folder
        file = write_components(Path(folder))
        with (
            deployment(file, "bench-groups") as pids,
            closing(DomainClient("bench-groups")) as client,
        ):
            return _measure(_rounds(client, Path(folder)), pids)


def _rounds(client: DomainClient, folder: Path) -> dict[str, Callable[[str, int], float]]:
    """For each variant a function that measures one round there."""
    interfaces = load_generated_interfaces(folder / "driver")
    calls = {}
    for variant in VARIANTS:
        channel = client.channel(interfaces.ROUNDS, f"{variant}-driver", "Rounds")
        channel.timeout = TIMEOUT_S
        channel.wait(TIMEOUT_S)
        calls[variant] = channel.bind(interfaces.ROUNDS.operation("once"))
    return calls


def _measure(
    rounds: dict[str, Callable[[str, int], float]], pids: dict[str, list[int]]
) -> list[dict[str, Any]]:
    took: dict[tuple[str, str], list[float]] = {}
    for number in range(ROUNDS + 1):
        order = VARIANTS if number % 2 else VARIANTS[::-1]
        for kind, count in KINDS.items():
            for variant in order:
                found = rounds[variant](kind, count)
                if number:  # the first round connects
                    took.setdefault((kind, variant), []).append(found)
    figures = [
        {"name": f"{kind}, {variant.rstrip('_')}", "value": median(values), "unit": "us"}
        for (kind, variant), values in took.items()
    ]
    for kind in KINDS:
        for other in ("zenoh", "local"):
            pairs = zip(took[kind, other], took[kind, "inprocess_"], strict=True)
            name = f"{kind}: {other} / inprocess"
            figures.append({"name": name, "value": median(a / b for a, b in pairs), "unit": ""})
    for variant in VARIANTS:
        begun = cpu(pids[variant])
        rounds[variant]("query", CPU_QUERIES)
        spent = (cpu(pids[variant]) - begun) / CPU_QUERIES * 1e6
        shown = variant.rstrip("_")
        figures.append({"name": f"CPU of a query, {shown}", "value": spent, "unit": "us"})
        figures.append({"name": f"memory, {shown}", "value": memory(pids[variant]), "unit": "MB"})
    figures += _idle(pids)
    return figures


def _idle(pids: dict[str, list[int]]) -> list[dict[str, Any]]:
    """The CPU time of the idle groups."""
    begun, seconds = {variant: cpu(pids[variant]) for variant in VARIANTS}, 5.0
    time.sleep(seconds)
    return [
        {
            "name": f"idle CPU, {variant.rstrip('_')}",
            "value": (cpu(pids[variant]) - begun[variant]) / seconds * 100,
            "unit": "%",
        }
        for variant in VARIANTS
    ]

"""How long `rcgen` takes, as a person waits for it: whole processes, from start to end.

Bytecode is kept, as `pip install` leaves it; the processes take turns, the figures are medians.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

ROUNDS = 15
RCGEN = str(Path(sys.executable).with_name("rcgen"))
COMPONENT = """\
import "Laser.idsl";
import "DifferentialRobot.idsl";
import "JointMotor.idsl";

/**
 * Follows a wall at a distance, and stops for people.
 */
Component follower
{
    Communications
    {
        requires Laser;
        requires DifferentialRobot, JointMotor;
        publishes JointMotorPublish;
    };
    language Python;
    period 50;
    middleware zenoh;
};
"""


def sixty_lines() -> str:
    """The component with comments, as people write them, up to 60 lines."""
    missing = 60 - COMPONENT.count("\n")
    return COMPONENT + "".join(f"// remark {i}: nothing to see here\n" for i in range(missing))


def run() -> list[dict[str, Any]]:
    """Figures for `--help`, `check` and `component`, and each against a bare Python."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "follower.cdsl")
        source.write_text(sixty_lines())
        output = iter(range(10**6))
        commands: dict[str, Callable[[], list[str]]] = {
            "python -c pass": lambda: [sys.executable, "-c", "pass"],
            "rcgen --help": lambda: [RCGEN, "--help"],
            "rcgen check": lambda: [RCGEN, "check", str(source)],
            "rcgen component": lambda: [
                RCGEN, "component", str(source), "-o", str(Path(folder, str(next(output))))
            ],
        }  # fmt: skip
        times: dict[str, list[float]] = {name: [] for name in commands}
        for _ in range(ROUNDS + 1):
            for name, command in commands.items():
                times[name].append(_timed(command(), environment))
    return _figures({name: median(taken[1:]) for name, taken in times.items()})


def _timed(command: list[str], environment: dict[str, str]) -> float:
    """Milliseconds."""
    begin = time.perf_counter()
    subprocess.run(command, env=environment, check=True, capture_output=True)
    return (time.perf_counter() - begin) * 1000


def _figures(medians: dict[str, float]) -> list[dict[str, Any]]:
    bare = medians.pop("python -c pass")
    goals = {"rcgen --help": 80, "rcgen check": 150, "rcgen component": 250}
    figures: list[dict[str, Any]] = [{"name": "python -c pass", "value": bare, "unit": "ms"}]
    for name, value in medians.items():
        ok = value <= goals[name]
        figures.append({"name": name, "value": value, "unit": "ms", "goal": goals[name], "ok": ok})
        figures.append({"name": f"{name} / python -c pass", "value": value / bare, "unit": "x"})
    return figures

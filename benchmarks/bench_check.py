"""What checking costs beyond parsing, in a process that keeps running, as an editor's server does.

A component with five imports; every round changes its text. Parsing and checking take turns.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from robocomp_dsl.check import check_file
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import parse_cdsl

ROUNDS = 200
INTERFACES = ("Laser", "JointMotor", "DifferentialRobot", "RGBD", "IMU")
COMPONENT = """\
{}
Component follower
{{
    Communications {{ requires {}; }};
    language Python;
}};
// {}
"""


def _text(number: int) -> str:
    imports = "\n".join(f'import "{name}.idsl";' for name in INTERFACES)
    return COMPONENT.format(imports, ", ".join(INTERFACES), number)


def run() -> list[dict[str, Any]]:
    """Median and 95th percentile, in ms."""
    beyond: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "follower.cdsl")
        workspace = Workspace(environ={})
        for number in range(ROUNDS + 1):
            begin = time.perf_counter()
            parse_cdsl(Source(path, _text(number)), Report())
            middle = time.perf_counter()
            workspace.files.open_buffer(path, _text(number))
            report = Report()
            check_file(path, workspace, report)
            if report.failed:
                raise AssertionError([one.message for one in report])
            beyond.append((time.perf_counter() - middle - (middle - begin)) * 1000)
    name = "check of a component with 5 imports, changed, beyond parsing"
    return [
        {"name": name, "value": median(beyond[1:]), "unit": "ms", "goal": 20},
        {
            "name": f"{name}, p95",
            "value": quantiles(beyond[1:], n=20)[-1],
            "unit": "ms",
            "goal": 20,
        },
    ]

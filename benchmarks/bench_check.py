"""What checking costs beyond parsing, in a process that keeps running, as an editor's server does.

A component with five imports; every round changes its text. Parsing and checking take turns.
Beside that, what one file costs `rcgen check` from its text to its findings, without the start of
the process: every file of this repository, and files of 1000 lines as nobody has them.
"""

from __future__ import annotations

import gc
import tempfile
import time
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from robocomp_dsl.check.languages import CHECKS, check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.program import GC_GEN0_THRESHOLD
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import parse_cdsl

ROOT = Path(__file__).resolve().parents[1]
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


LINES = 1000
LARGE = {
    "structs": ("", "struct S{0} {{ int a{0}; }};", ""),
    "operations": ("interface I {", "void go{0}(int a, out float b);", "};"),
    "unknown types": ("struct S {", "Typo{0} f{0};", "};"),
}
"""Kind of a large file to what stands before, in and behind its lines."""
GOAL = 50
REPEATS = 5


def _once(path: Path) -> float:
    """Milliseconds of checking one file with nothing kept from another one."""
    begin = time.perf_counter()
    check_file(path, Workspace(environ={}), Report())
    return (time.perf_counter() - begin) * 1000


def _cost(path: Path) -> float:
    return median(_once(path) for _ in range(REPEATS))


def per_file() -> list[dict[str, Any]]:
    """Milliseconds a file."""
    files = [
        path
        for folder in ("interfaces", "components", "tests/golden")
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in CHECKS and path.suffix != ".xml"
    ]
    gc.set_threshold(GC_GEN0_THRESHOLD)  # as in a command
    _cost(files[0])  # what is loaded on first use is start-up
    costs = sorted(_cost(path) for path in files)
    rows = {
        f"check of a file of the repository ({len(files)} files), median": median(costs),
        f"check of a file of the repository ({len(files)} files), worst": costs[-1],
    }
    with tempfile.TemporaryDirectory() as folder:
        for kind, (before, line, behind) in LARGE.items():
            body = "\n".join(line.format(number) for number in range(LINES))
            path = Path(folder, f"{kind.replace(' ', '')}.idsl")
            path.write_text(f"module M {{ {before}\n{body}\n{behind} }};\n")
            rows[f"check of {LINES} lines of {kind}"] = _cost(path)
    return [{"name": n, "value": value, "unit": "ms", "goal": GOAL} for n, value in rows.items()]


def run() -> list[dict[str, Any]]:
    """Medians and a 95th percentile, in ms."""
    return changed() + per_file()


def changed() -> list[dict[str, Any]]:
    """Median and 95th percentile of checking again, in ms."""
    beyond: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "follower.cdsl")
        workspace = Workspace(environ={})
        for number in range(ROUNDS + 1):
            begin = time.perf_counter()
            parse_cdsl(Source(path, _text(number)), Report())
            middle = time.perf_counter()
            workspace.sources.set_overlay(path, _text(number))
            report = Report()
            check_file(path, workspace, report)
            if report.has_errors:
                raise AssertionError([finding.message for finding in report])
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

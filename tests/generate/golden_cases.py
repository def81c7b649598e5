"""The golden cases: folders in `tests/golden` with a CDSL file; `expected/` is what it gives."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.output import render
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import OutputFile, plan
from robocomp_dsl.model.component import Component

GOLDEN = Path(__file__).parents[1] / "golden"
CASES = sorted(p.name for p in GOLDEN.iterdir() if any(p.glob("*.cdsl")))


def component(path: Path) -> Component:
    """The component in a CDSL file without errors; only shipped interfaces are found beside it."""
    report = Report()
    found = check_cdsl(path, Workspace(environ={}), report)
    assert not report.has_errors, render.full(report)
    assert found is not None
    return found


def files(case: str) -> list[OutputFile]:
    """What is generated for a case."""
    (path,) = (GOLDEN / case).glob("*.cdsl")
    return plan(component(path))


def put(files: list[OutputFile], folder: Path) -> None:
    """Bring files into an empty folder."""
    for file in files:
        path = folder / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(file.data)

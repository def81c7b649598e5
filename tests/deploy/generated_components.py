"""Two generated components for the tests of deployments: `arm` serves, `eye` calls."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write

ARM = """
import "Laser.idsl";
Component arm
{
    Communications { implements Laser; };
    language Python;
    parameters "arm.pdsl";
};
"""
PARAMETERS = """
ComponentParams arm
{
    rate float 50 [Hz] 1:1000 live;
    serial string;
    motors[0:4] { id int 0 0:127; };
    weights[1:4] float 1.0 [kg] 0:10 live;
    names[] string live;
};
"""
EYE = """
import "Laser.idsl";
Component eye
{
    Communications { requires Laser; };
    language Python;
};
"""
HEAD = """
from __future__ import annotations
import os
import signal
import sys
import time
from {name}_generated.genericworker import GenericWorker
from {name}_generated.interfaces import *
"""


def generate_components(folder: Path, workers: dict[str, str] | None = None) -> None:
    """Generate both below `folder`; `workers` are the bodies of their `SpecificWorker`."""
    for name, text in (("arm", ARM), ("eye", EYE)):
        cdsl = folder / name / f"{name}.cdsl"
        cdsl.parent.mkdir()
        cdsl.write_text(text)
        (cdsl.parent / "arm.pdsl").write_text(PARAMETERS)
        report = Report()
        component = check_cdsl(cdsl, Workspace(), report)
        assert component
        assert not report.has_errors
        write(cdsl.parent, plan(component))
        if workers and name in workers:
            (cdsl.parent / "specificworker.py").write_text(HEAD.format(name=name) + workers[name])

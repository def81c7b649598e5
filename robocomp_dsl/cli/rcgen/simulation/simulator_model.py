"""`rcgen simulator` of a model file in URDF or MJCF.

In: its path. Out: the simulator, whose world is built once as a check; findings.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from robocomp_dsl.check.model_file.model_findings import (
    read_source,
    report_error,
    report_findings,
)
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.simulator.simulator import Simulator, simulator_of_model
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.hardware.description.model_kind import MODELS, root_tag
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.simulation.models.model_copy import copy_model
from robocomp_dsl.simulation.models.model_scene import describe
from robocomp_dsl.simulation.world.simulation import Simulation
from robocomp_dsl.source import Source


def model_world(
    path: Path,
    packages: Sequence[Path],
    report: Report,
    complete: Callable[[Simulator], Simulator],
) -> Simulator | None:
    """The simulator of the model at `path`, finished by `complete`; None after errors."""
    source = read_source(path)
    try:
        file = f"model{MODELS.get(root_tag(read_bytes(path)), '.xml')}"
        described = describe(path, file, packages)
        text = copy_model(path, packages)
    except ModelFileError as error:
        report_error(error, source, report)
        return None
    except OSError as error:
        message = f"`{error.filename or path}` cannot be read: {error.strerror or error}"
        report.add(codes.IMPOSSIBLE_WORLD, source.file_span, message)
        return None
    report_findings(described.findings, source, report)
    simulator_ = complete(simulator_of_model(path, described.scene, text, step=described.step))
    _build(simulator_, file, source, report)
    return simulator_


def _build(simulator_: Simulator, file: str, source: Source, report: Report) -> None:
    """Build the world of the copy, like the component."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, file).write_text(simulator_.model, "utf-8")
        try:
            simulation = Simulation(Scene.of_data(simulator_.scene, Path(folder)))
        except HardwareError as error:
            report.add(codes.IMPOSSIBLE_WORLD, source.file_span, str(error))
            return
    report_findings(simulation.overlaps(), source, report)

"""`rcgen simulator` of a model file in URDF or MJCF.

In: its path. Out: what is simulated and served, built once to see that it can be; findings.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from robocomp_dsl.cli.model_findings import read_source, tell, tell_faults
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.simulator import Simulator, simulator_of_model
from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.findings import ModelFileError
from robocomp_dsl.hardware.model_kind import MODELS, outermost
from robocomp_dsl.hardware.mujoco.model_copy import copy_of
from robocomp_dsl.hardware.mujoco.model_scene import describe
from robocomp_dsl.hardware.mujoco.simulation import Simulation
from robocomp_dsl.hardware.scene import Scene
from robocomp_dsl.source import Source


def model_world(
    path: Path,
    packages: Sequence[Path],
    report: Report,
    complete: Callable[[Simulator], Simulator],
) -> Simulator | None:
    """The simulator of the model at `path`, as `complete` makes it whole; None after errors."""
    source = read_source(path)
    try:
        file = f"model{MODELS.get(outermost(path.read_bytes()), '.xml')}"
        described = describe(path, file, packages)
        text = copy_of(path, packages)
    except ModelFileError as error:
        tell_faults(error, source, report)
        return None
    except OSError as error:
        said = f"`{error.filename or path}` cannot be read: {error.strerror or error}"
        report.add(codes.IMPOSSIBLE_WORLD, source.whole, said)
        return None
    tell(described.findings, source, report)
    made = complete(simulator_of_model(path, described.scene, text, step=described.step))
    _build(made, file, source, report)
    return made


def _build(made: Simulator, file: str, source: Source, report: Report) -> None:
    """Build the world of the copy, as the component will."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, file).write_text(made.model, "utf-8")
        try:
            simulation = Simulation(Scene.of_data(made.scene, Path(folder)))
        except HardwareError as error:
            report.add(codes.IMPOSSIBLE_WORLD, source.whole, str(error))
            return
    tell(simulation.overlaps(), source, report)

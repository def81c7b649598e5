"""Checks a model file, URDF or MJCF, by itself.

In: the path of a file. Out: diagnostics about what MuJoCo cannot read, about what it simplifies,
and about values that are unlikely.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.codes import model_files as codes
from robocomp_dsl.check.model_file.model_findings import (
    read_source,
    report_error,
    report_findings,
)
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.description.findings import ModelFileError


def check_model(path: Path, report: Report) -> None:
    """Check the model at `path`."""
    source = read_source(path)
    try:
        from robocomp_dsl.simulation.models.model_file import load_model  # noqa: PLC0415 - MuJoCo
        from robocomp_dsl.simulation.models.unlikely_values import unlikely_values  # noqa: PLC0415
    except ImportError as missing:
        message = f"`{path.name}` cannot be checked without MuJoCo: {missing}"
        report.add(codes.MODEL_FILE, source.file_span, message)
        return
    try:
        loaded = load_model(path)
        report_findings(loaded.findings, source, report)
        report_findings(unlikely_values(loaded, path), source, report)
    except ModelFileError as error:
        report_error(error, source, report)
    except OSError as error:
        message = f"`{error.filename or path}` cannot be read: {error.strerror or error}"
        report.add(codes.MODEL_FILE, source.file_span, message)

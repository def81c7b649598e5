"""Loads a model file, URDF or MJCF, as a compiled MuJoCo model.

In: a path and folders of packages. Out: the compiled model with its spec, and findings on
deviations from the file; `ModelFileError` with the relevant lines if no model can be built.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import ModelFileError, model_finding
from robocomp_dsl.hardware.description.model_kind import root_tag
from robocomp_dsl.hardware.formats.urdf import read_urdf
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.simulation.models.mjcf_spec import build_mjcf, error_with_line
from robocomp_dsl.simulation.models.urdf_spec import build_urdf
from robocomp_dsl.simulation.world.arena import reserve_arena
from robocomp_dsl.simulation.world.overlaps import overlaps

_WEIGHTLESS = "mass and inertia of moving bodies"
_LIGHTEST = 1e-3


@dataclass(slots=True)
class LoadedModel:
    """`spec` is the specification of `model`."""

    spec: Any
    model: Any
    findings: list[Finding]


def load_model(path: Path, packages: Sequence[Path] = ()) -> LoadedModel:
    """The compiled model in the file at `path`. Raises `ModelFileError`, `OSError`."""
    spec, findings = read_spec(path, packages)
    return LoadedModel(spec, compiled(spec, findings), findings)


def read_spec(path: Path, packages: Sequence[Path] = ()) -> tuple[Any, list[Finding]]:
    """The uncompiled model in the file at `path`. Raises `ModelFileError`, `OSError`."""
    data = read_bytes(path)
    match root_tag(data):
        case "robot":
            return build_urdf(read_urdf(data), path, packages)
        case "mujoco":
            return build_mjcf(path, packages)
        case "mujocoinclude":
            raise ModelFileError("this is a part of a model: give the file that includes it")
        case tag:
            message = f"the outermost element is `<{tag}>`" if tag else "the file holds no element"
            raise ModelFileError(f"{message}, a model begins with `<robot>` or `<mujoco>`")


def compiled(spec: Any, findings: list[Finding]) -> Any:
    """The model of `spec`; moving parts without mass get some. Raises `ModelFileError`."""
    reserve_arena(spec, len(spec.bodies))
    try:
        model = _compile(spec, findings)
    except ModelFileError as error:
        if _WEIGHTLESS not in str(error):
            raise
        spec.compiler.boundmass, spec.compiler.boundinertia = _LIGHTEST, _LIGHTEST * 1e-3
        model = _compile(spec, findings)
        findings += _light(model)
    _require_finite(model)
    findings += overlaps(model)
    return model


_NUMBERS = {
    "body": ("pos", "quat", "mass", "inertia", "ipos", "iquat"),
    "jnt": ("pos", "axis", "range", "stiffness"),
    "geom": ("pos", "quat", "size"),
    "site": ("pos", "quat"),
    "cam": ("pos", "quat", "fovy"),
}
"""Attributes that MuJoCo does not check for finite values."""


def _require_finite(model: Any) -> None:
    """Raises `ModelFileError` for attributes that are not finite."""
    for kind, names in _NUMBERS.items():
        for name in names:
            numbers = getattr(model, f"{kind}_{name}")
            if np.isfinite(numbers).all():
                continue
            at = int(np.argwhere(~np.isfinite(numbers))[0][0])
            element = getattr(model, _KINDS[kind])(at)
            message = (
                f"the {_KINDS[kind]} `{element.name or at}` has a `{name}` that is no finite number"
            )
            raise ModelFileError(message)


_KINDS = {"body": "body", "jnt": "joint", "geom": "geom", "site": "site", "cam": "camera"}


def _compile(spec: Any, findings: list[Finding]) -> Any:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            model = spec.compile()
        except (ValueError, mujoco.FatalError) as error:
            raise error_with_line(error) from None
    findings += [model_finding("file", "", str(warning.message)) for warning in caught]
    return model


def _light(model: Any) -> list[Finding]:
    return [
        model_finding("mass", name, f"`{name}` moves and has no mass: it gets {_LIGHTEST:g} kg")
        for i in range(1, model.nbody)
        if model.body_jntnum[i] and model.body_mass[i] <= _LIGHTEST
        for name in [model.body(i).name or f"body{i}"]
    ]

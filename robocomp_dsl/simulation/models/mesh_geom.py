"""A mesh file as a geom of MuJoCo, or a placeholder box.

In: a body of an `MjSpec`, a file and a scale. Out: settings of a geom, with a finding if it is a
placeholder. Points are in the axes of the file: m, z up, as in URDF and MJCF.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.formats.mesh_file import MeshError, Surface, read_surface
from robocomp_dsl.hardware.kinematics.rotations import Matrix

UNKNOWN = 0.1
"""m: edge of the cube, before scaling, used for a mesh of unknown size."""

_THINNEST = 1e-6
_PLACEHOLDER = (0.9, 0.4, 0.2, 0.4)
_GEOM = mujoco.mjtGeom


@dataclass(slots=True)
class MeshCache:
    """The meshes of a spec: each file and scale is read and added once."""

    spec: Any
    findings: list[Finding]
    _made: dict[tuple[Path, tuple[float, ...]], dict[str, Any]] = field(default_factory=dict)

    def geom(self, path: Path, scale: tuple[float, ...], subject: str, line: int) -> dict[str, Any]:
        """The `type` of the geom and its arguments; `shift` is the centre of a box."""
        key = (path, scale)
        if key not in self._made:
            self._made[key] = self._new(path, scale, subject, line)
        return dict(self._made[key])

    def _new(self, path: Path, scale: tuple[float, ...], subject: str, line: int) -> dict[str, Any]:
        try:
            surface = read_surface(path)
        except MeshError as error:
            size = [abs(part) * UNKNOWN / 2 for part in scale]
            edge = f"a box of {' x '.join(f'{2 * part:.3g}' for part in size)} m"
            message = f"the mesh `{path}` of `{subject}` is {edge}: {error}"
            self.findings.append(model_finding("mesh", subject, message, line))
            return _box(size, np.zeros(3)) | {"rgba": _PLACEHOLDER}
        points = surface.points * scale
        low, high = points.min(axis=0), points.max(axis=0)
        if len(surface.faces) and not is_flat(points):
            return self._mesh(path, surface, points, scale)
        if not len(surface.faces):
            message = (
                f"the mesh `{path.name}` of `{subject}` is its bounding box; convert it to .obj"
            )
            self.findings.append(model_finding("mesh", subject, message, line))
        return _box(((high - low) / 2).tolist(), (low + high) / 2)

    def _mesh(
        self, path: Path, surface: Surface, points: Matrix, scale: tuple[float, ...]
    ) -> dict[str, Any]:
        faces = surface.faces if np.prod(scale) > 0 else surface.faces[:, ::-1]
        asset = self.spec.add_mesh(
            name=f"{path.stem}.{len(self._made)}",
            uservert=points.ravel().tolist(),
            userface=faces.ravel().tolist(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        return {"type": _GEOM.mjGEOM_MESH, "meshname": asset.name, "shift": np.zeros(3)}


def _box(half: list[float], centre: Matrix) -> dict[str, Any]:
    size = [max(part, _THINNEST) for part in half]
    return {"type": _GEOM.mjGEOM_BOX, "size": size, "shift": centre}


def is_flat(points: Matrix) -> bool:
    """Whether the points, shape (n, 3), are coplanar; MuJoCo rejects such meshes."""
    if len(points) < 4:
        return True
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[2] < 1e-6 * spread[0])

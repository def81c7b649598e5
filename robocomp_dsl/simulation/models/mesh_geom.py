"""A mesh file as a geom of MuJoCo.

In: an `MjSpec`, a file and a scale. Out: settings of a geom; none for a file that cannot be read. A
finding tells each deviation. Points are in the axes of the file: m, z up, as in URDF and MJCF.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.formats.mesh_file import read_surface
from robocomp_dsl.hardware.formats.surface import MeshError, Surface, scaled, used_part
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.simulation.models.mesh_marker import add_marker

Settings: TypeAlias = dict[str, Any]

_THINNEST = 1e-6
_LARGEST = 1e6  # m
_GEOM = mujoco.mjtGeom


@dataclass(slots=True)
class MeshCache:
    """The meshes of a spec: each file and scale is read and added once."""

    spec: Any
    findings: list[Finding]
    _geoms: dict[tuple[Path, tuple[float, ...]], Settings | None] = field(default_factory=dict)
    _markers: int = 0

    def geom(
        self, path: Path, scale: tuple[float, ...], subject: str, line: int
    ) -> Settings | None:
        """The `type` of the geom and its arguments; `shift` is the centre of a box.

        None if the file cannot be read: the caller adds a marker with `mark`.
        """
        key = (path, scale)
        if key not in self._geoms:
            self._geoms[key] = self._new(path, scale, subject, line)
        known = self._geoms[key]
        return None if known is None else dict(known)

    def mark(self, body: Any, path: Path, pos: Matrix) -> None:
        """Mark the place of an unreadable mesh."""
        self._markers += 1
        add_marker(body, f"{path.name} {self._markers}", pos)

    def _new(
        self, path: Path, scale: tuple[float, ...], subject: str, line: int
    ) -> Settings | None:
        try:
            whole = scaled(read_surface(path), scale, _LARGEST)
        except MeshError as error:
            message = f"the mesh `{path}` of `{subject}` is a small marker: {error}"
            self.findings.append(model_finding("mesh", subject, message, line))
            return None
        surface = used_part(whole)
        points = surface.points
        low, high = points.min(axis=0), points.max(axis=0)
        if len(surface.faces) and not is_flat(points):
            return self._mesh(path, surface, scale)
        if not len(surface.faces):
            message = f"the mesh `{path.name}` of `{subject}` is {bounding_box_reason(whole)}"
            self.findings.append(model_finding("mesh", subject, message, line))
        return _box(((high - low) / 2).tolist(), (low + high) / 2)

    def _mesh(self, path: Path, surface: Surface, scale: tuple[float, ...]) -> Settings:
        faces = surface.faces if np.prod(scale) > 0 else surface.faces[:, ::-1]
        asset = self.spec.add_mesh(
            name=f"{path.stem}.{len(self._geoms)}",
            uservert=surface.points.ravel().tolist(),
            userface=faces.ravel().tolist(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        return {"type": _GEOM.mjGEOM_MESH, "meshname": asset.name, "shift": np.zeros(3)}


def _box(half: list[float], centre: Matrix) -> Settings:
    size = [max(part, _THINNEST) for part in half]
    return {"type": _GEOM.mjGEOM_BOX, "size": size, "shift": centre}


def bounding_box_reason(surface: Surface) -> str:
    """How a mesh without usable faces is shown, and why."""
    why = "its faces have no area" if len(surface.faces) else "its faces are not read; use .obj"
    return f"its bounding box: {why}"


def is_flat(points: Matrix) -> bool:
    """Whether the points, shape (n, 3), are coplanar; MuJoCo rejects such meshes."""
    if len(points) < 4:
        return True
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[2] < 1e-6 * spread[0])

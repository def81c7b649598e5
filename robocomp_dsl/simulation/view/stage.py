"""A model as nodes of a viser scene that follow its state.

In: a viser server, a model, and its visual state. Out: one node per body under its parent's node,
so that the viewer's tree matches the model; shapes, labels, points and contacts.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.simulation.models.mesh_marker import MARKER_COLOUR, marked_meshes, marker_size
from robocomp_dsl.simulation.view.shapes import colour, triangles
from robocomp_dsl.simulation.world.visual_state import VisualState

Floats = NDArray[np.float64]
Colours = NDArray[np.uint8]

_INVISIBLE_GROUPS = 3
"""Groups from this index on are hidden, as in MuJoCo's own viewer."""


class Stage:
    """The browser scene of one model. Not thread-safe: the caller holds a lock."""

    def __init__(self, server: Any, model: Any, seen: VisualState) -> None:
        self.server, self.model = server, model
        self.extent = max(float(model.stat.extent), 0.1)
        self.paths = _paths(model)
        self._contacts_on = False
        self._contacts: Any = None
        self._clouds: dict[str, Any] = {}
        self._seen = seen
        self.relative: Floats = np.full((model.nbody, 7), np.nan)
        self.frames = [self._frame(i) for i in range(1, model.nbody)]
        self.labels = [
            server.scene.add_label(f"{path}/name", self.names[i], visible=False)
            for i, path in enumerate(self.paths)
            if i
        ]
        for geom in range(model.ngeom):
            if model.geom_group[geom] < _INVISIBLE_GROUPS:
                self._show(geom)
        for site, name in marked_meshes(model).items():
            self._mark(site, name)
        self.update(seen)

    @property
    def names(self) -> list[str]:
        """Names of the bodies; unnamed ones get their index."""
        return [self.model.body(i).name or f"body{i}" for i in range(self.model.nbody)]

    def _frame(self, body: int) -> Any:
        return self.server.scene.add_frame(
            self.paths[body],
            show_axes=False,
            axes_length=0.08 * self.extent,
            axes_radius=0.003 * self.extent,
        )

    def _show(self, geom: int) -> None:
        surface = triangles(self.model, geom)
        red, green, blue, opaque = colour(self.model, geom)
        if surface is None or not len(surface.faces) or opaque == 0:
            return
        name = _safe(self.model.geom(geom).name or f"shape{geom}")
        self.server.scene.add_mesh_simple(
            f"{self.paths[self.model.geom_bodyid[geom]]}/{name}:shape",
            surface.points.astype(np.float32),
            surface.faces,
            color=(red, green, blue),
            opacity=opaque if opaque < 1 else None,
            flat_shading=True,
            position=self.model.geom_pos[geom],
            wxyz=self.model.geom_quat[geom],
        )

    def _mark(self, site: int, name: str) -> None:
        """Show the marker of a missing mesh."""
        self.server.scene.add_box(
            f"{self.paths[self.model.site_bodyid[site]]}/{_safe(name)}:missing mesh",
            color=MARKER_COLOUR[:3],
            dimensions=(marker_size(self.extent),) * 3,
            position=self.model.site_pos[site],
        )

    def update(self, seen: VisualState) -> None:
        """Show poses and contacts; unchanged poses are not sent."""
        self._seen = seen
        poses = relative_poses(self.model, seen.poses)
        moved = np.flatnonzero(~np.isclose(poses, self.relative, atol=1e-7, rtol=0).all(axis=1))
        with self.server.atomic():
            for body in moved:
                if body:
                    handle = self.frames[body - 1]
                    handle.position, handle.wxyz = poses[body, :3], poses[body, 3:]
            if self._contacts_on:
                self._touch()
        self.relative[moved] = poses[moved]

    def show_frames(self, on: bool) -> None:
        """The axes of all bodies: x red, y green, z blue."""
        for handle in self.frames:
            handle.show_axes = on

    def show_names(self, on: bool) -> None:
        """The names of all bodies."""
        for handle in self.labels:
            handle.visible = on

    def show_points(
        self, name: str, body: str, points: Floats, colours: Colours, size: float
    ) -> None:
        """Points (n, 3) in the frame of a body, in m, with colours (n, 3); they move with it.

        A second call with the same name changes them. Raises `KeyError` for an unknown body.
        """
        at = f"{self.paths[self.model.body(body).id]}/{_safe(name)}:points"
        known = self._clouds.get(at)
        if known is not None and len(known.points) == len(points):
            known.points, known.colors = points.astype(np.float32), colours
        else:
            self._clouds[at] = self.server.scene.add_point_cloud(
                at,
                points.astype(np.float32),
                colours,
                point_size=size,
                precision="float32",
                point_shape="circle",
                point_shading="flat",
            )

    def show_contacts(self, on: bool) -> None:
        """Contact points, with an arrow along the normal of each."""
        self._contacts_on = on
        self._touch()

    def _touch(self) -> None:
        if self._contacts is not None:
            self._contacts.remove()
            self._contacts = None
        points, normals = self._seen.contacts[:, :3], self._seen.contacts[:, 3:]
        if not self._contacts_on or not len(points):
            return
        ends = np.stack((points, points + 0.08 * self.extent * normals), axis=1)
        self._contacts = self.server.scene.add_arrows(
            "/contacts",
            ends.astype(np.float32),
            (230, 60, 30),
            shaft_radius=0.004 * self.extent,
            head_radius=0.01 * self.extent,
            head_length=0.02 * self.extent,
        )


def relative_poses(model: Any, poses: Floats) -> Floats:
    """Position and quaternion (w, x, y, z) of every body in its parent, shape (nbody, 7).

    `poses` are the poses in the world, of the same shape.
    """
    above = poses[model.body_parentid]
    back = above[:, 3:] * (1, -1, -1, -1)
    away = np.zeros((len(poses), 4))
    away[:, 1:] = poses[:, :3] - above[:, :3]
    turned = _product(_product(back, away), above[:, 3:])
    return np.concatenate((turned[:, 1:], _product(back, poses[:, 3:])), axis=1)


def _product(first: Floats, other: Floats) -> Floats:
    """Hamilton product of quaternions (w, x, y, z), row by row."""
    a, u, b, v = first[:, :1], first[:, 1:], other[:, :1], other[:, 1:]
    real = a * b - (u * v).sum(axis=1, keepdims=True)
    return np.concatenate((real, a * v + b * u + np.cross(u, v)), axis=1)


def _paths(model: Any) -> list[str]:
    """The name of a node in viser contains its path: `/base/arm/hand`."""
    paths = ["/world"]
    for i in range(1, model.nbody):
        name = _safe(model.body(i).name or f"body{i}")
        paths.append(f"{paths[model.body_parentid[i]]}/{name}")
    return paths


def _safe(name: str) -> str:
    return name.replace("/", "|")

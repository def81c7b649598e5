"""A model as nodes of a viser scene, which follow its state.

In: a viser server, `MjModel` and `MjData`. Out: one node per body under that of its parent, so that
the viewer's own tree is the model's; shapes, labels and contacts in it.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.view.shapes import colour, triangles

_MOST_CONTACTS = 500
_INVISIBLE_GROUPS = 3
"""Groups from this one on are hidden, as MuJoCo's own viewer has it."""


class Stage:
    """What is to be seen of one model. Not thread-safe: the caller holds a lock."""

    def __init__(self, server: Any, model: Any, data: Any) -> None:
        self.server, self.model = server, model
        self.extent = max(float(model.stat.extent), 0.1)
        self.paths = _paths(model)
        self._contacts_on = False
        self._contacts: Any = None
        self._poses: NDArray[np.float64] = np.full((model.nbody, 7), np.nan)
        self.frames = [self._frame(i) for i in range(1, model.nbody)]
        self.labels = [
            server.scene.add_label(f"{path}/name", self.names[i], visible=False)
            for i, path in enumerate(self.paths)
            if i
        ]
        for geom in range(model.ngeom):
            if model.geom_group[geom] < _INVISIBLE_GROUPS:
                self._show(geom)
        self.follow(data)

    @property
    def names(self) -> list[str]:
        """Of the bodies, by number; those without one are numbered."""
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

    def follow(self, data: Any) -> None:
        """Show the poses and contacts of `data`; what has not moved is not sent."""
        poses = relative_poses(self.model, data)
        moved = np.flatnonzero(~np.isclose(poses, self._poses, atol=1e-7, rtol=0).all(axis=1))
        with self.server.atomic():
            for body in moved:
                if body:
                    handle = self.frames[body - 1]
                    handle.position, handle.wxyz = poses[body, :3], poses[body, 3:]
            if self._contacts_on:
                self._touch(data)
        self._poses[moved] = poses[moved]

    def show_frames(self, on: bool) -> None:
        """The axes of all bodies: x red, y green, z blue."""
        for handle in self.frames:
            handle.show_axes = on

    def show_names(self, on: bool) -> None:
        """The names of all bodies."""
        for handle in self.labels:
            handle.visible = on

    def show_contacts(self, data: Any, on: bool) -> None:
        """Points that touch, and an arrow along the normal of each."""
        self._contacts_on = on
        self._touch(data)

    def _touch(self, data: Any) -> None:
        if self._contacts is not None:
            self._contacts.remove()
            self._contacts = None
        points = data.contact.pos[:_MOST_CONTACTS] if data.ncon else np.empty((0, 3))
        if not self._contacts_on or not len(points):
            return
        normals = data.contact.frame[:_MOST_CONTACTS, :3]
        ends = np.stack((points, points + 0.08 * self.extent * normals), axis=1)
        self._contacts = self.server.scene.add_arrows(
            "/contacts",
            ends.astype(np.float32),
            (230, 60, 30),
            shaft_radius=0.004 * self.extent,
            head_radius=0.01 * self.extent,
            head_length=0.02 * self.extent,
        )


def relative_poses(model: Any, data: Any) -> NDArray[np.float64]:
    """Place and quaternion (w, x, y, z) of every body in its parent, shape (nbody, 7)."""
    made = np.zeros((model.nbody, 7))
    turn = data.xmat.reshape(-1, 3, 3)
    above = model.body_parentid
    back = turn[above].transpose(0, 2, 1)
    made[:, :3] = np.einsum("nij,nj->ni", back, data.xpos - data.xpos[above])
    inside = (back @ turn).reshape(-1, 9)
    for i in range(model.nbody):
        mujoco.mju_mat2Quat(made[i, 3:], inside[i])
    return made


def _paths(model: Any) -> list[str]:
    """A node's name in viser says where it hangs: `/base/arm/hand`."""
    made = ["/world"]
    for i in range(1, model.nbody):
        name = _safe(model.body(i).name or f"body{i}")
        made.append(f"{made[model.body_parentid[i]]}/{name}")
    return made


def _safe(name: str) -> str:
    return name.replace("/", "|")

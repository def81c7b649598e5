"""Offscreen pictures of the robot's arm, with the skin in the colours of pressure.

In: a recording, the robot's body, times. Out: pixels; raises `NoRendering`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import mujoco
import numpy as np
from body import CAMERA, Body
from colours import on_robot
from metrics import TouchMetrics, arm_at
from numpy.typing import NDArray
from recording import Floats, Recording

from robocomp_dsl.simulation.view.picture import Renderer, Viewpoint

Pixels = NDArray[np.uint8]

_OPENING = 28.0
"""Vertical field of view of the camera, in degrees."""


def best_seen(it: Recording, body: Body, touches: Sequence[TouchMetrics]) -> TouchMetrics:
    """A touch whose place faces the camera and moves far."""

    def worth(touch: TouchMetrics) -> float:
        if touch.trouble:
            return -1.0
        body.pose(it.rest, arm_at(it, touch.contact))
        place = it.place(touch.place)
        return touch.withdrawn * max(
            float(body.outward(place) @ towards_camera(body.centre(place))), 0.01
        )

    return max(touches, key=worth)


def before_and_after(
    it: Recording, body: Body, touch: TouchMetrics, highest: float, size: tuple[int, int]
) -> tuple[Pixels, Pixels]:
    """Pictures at the maximum force of a touch, and when the arm is farthest away.

    `size` is width and height in pixels. Raises `NoRendering`.
    """
    pressed = (it.frame_time >= touch.contact) & (it.frame_time <= touch.farthest)
    felt = np.where(pressed, it.force.sum(axis=1), -1.0)
    moments = (float(it.frame_time[int(felt.argmax())]), touch.farthest)
    width, height = size
    with Renderer(body.model, width, height) as painter:
        _show(it, body, moments[0], highest)
        _aim(body, it, moments, width / height)
        first, last = (_paint(it, body, painter, moment, highest) for moment in moments)
    return first, last


def _paint(it: Recording, body: Body, painter: Renderer, moment: float, highest: float) -> Pixels:
    _show(it, body, moment, highest)
    return painter.render(body.data, Viewpoint(camera=CAMERA)).copy()


def _show(it: Recording, body: Body, moment: float, highest: float) -> None:
    """Set the robot's pose at `moment`."""
    look = min(int(np.searchsorted(it.finger_time, moment)), len(it.finger) - 1)
    frame = max(int(np.searchsorted(it.frame_time, moment, side="right")) - 1, 0)
    body.model.site_rgba[body.sites] = on_robot(it.force[frame], highest)
    body.pose(it.rest, arm_at(it, moment), it.finger[look])


def _aim(body: Body, it: Recording, moments: tuple[float, float], aspect: float) -> None:
    """Place the camera ahead on the arm's side, so that it sees the arm at all times."""
    points = np.concatenate([_arm(body, it, moment) for moment in moments])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    eye = towards_camera(middle)
    across = np.cross([0, 0, 1], eye)
    across /= np.linalg.norm(across)
    turn = np.column_stack((across, np.cross(eye, across), eye))
    camera = body.model.camera(CAMERA).id
    opening = math.radians(_OPENING) * min(1.0, aspect)
    body.model.cam_pos[camera] = middle + eye * radius / math.sin(opening / 2) * 1.15
    mujoco.mju_mat2Quat(body.model.cam_quat[camera], turn.ravel())
    body.model.cam_fovy[camera] = _OPENING


def towards_camera(place: Floats) -> Floats:
    """The unit vector to the camera: robots look along x, and y is to their left."""
    eye = np.array([0.8, 0.75 if place[1] >= 0 else -0.75, 0.35])
    towards: Floats = eye / np.linalg.norm(eye)
    return towards


def _arm(body: Body, it: Recording, moment: float) -> Floats:
    """Positions of the arm's taxels at `moment`, and of the shoulder."""
    body.pose(it.rest, arm_at(it, moment))
    limbs = [i for i, name in enumerate(it.skin.limbs) if name.startswith(f"{it.part}/")]
    mine = body.sites[np.isin(it.skin.limb, limbs)]
    found: Floats = body.data.site_xpos[mine].copy()
    return found

"""A model in the browser, on this machine and for this user only.

In: a model, its state, a port. Out: a self-contained page at 127.0.0.1 that shows them; changes on
the page change the state. Needs the extra `view`.
"""

from __future__ import annotations

import logging
import math
import socket
import time
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.runtime.private_folder import read_page_token
from robocomp_dsl.simulation.view.controls import Controls
from robocomp_dsl.simulation.view.page_guard import PageGuard
from robocomp_dsl.simulation.view.picture import Viewpoint, find_camera, scene_extent
from robocomp_dsl.simulation.view.remote_simulation import SimulationControl
from robocomp_dsl.simulation.view.stage import Colours, Floats, Stage
from robocomp_dsl.simulation.world.visual_state import VisualState, capture

try:
    import rich
    import viser
except ModuleNotFoundError as error:
    raise MissingExtra("the view in the browser", "view", error) from None

DEFAULT_VIEWPOINT = Viewpoint()
LOOPBACK = "127.0.0.1"
_DIRECTION = np.array([-0.6, -0.75, 0.5])
_PICTURES = 30.0  # per second
_MOST_BEHIND = 0.1  # s: maximum delay that running physics catches up with


class BrowserPage:
    """Open until `close`. `model` and `data` belong to it, or are used under `controls.lock`.

    To show another state: set joints in `data`, call `mujoco.mj_kinematics`, and then
    `refresh`; or pass poses to `follow`. `remote` controls a world in another process. `url`
    contains the token of the user, without which nothing is served (see `page_guard`).

    Raises `OSError` if the port is in use, `UnsafeFolder` if the token cannot be read, and
    `NoRendering` if the model does not have the camera of the viewpoint.
    """

    def __init__(
        self,
        name: str,
        model: Any,
        data: Any,
        look: Viewpoint = DEFAULT_VIEWPOINT,
        *,
        port: int = 0,
        remote: SimulationControl | None = None,
    ) -> None:
        if look.camera:
            find_camera(model, look.camera)
        self._look, self._remote = look, remote
        self._points: dict[str, tuple[str, Floats, Colours, float]] = {}
        port = _free(port)  # viser would silently use another port
        logging.getLogger("websockets").setLevel(logging.ERROR)
        rich.get_console().quiet = True  # viser shows a panel of its own at first
        guard = PageGuard(read_page_token())
        with guard.install():
            self._server = viser.ViserServer(host=LOOPBACK, port=port, label=name, verbose=False)
        # a page could request a tunnel to an external server
        self._server.request_share_url = _no_tunnel  # type: ignore[method-assign]
        self.port = self._server.get_port()
        self.url = f"http://{LOOPBACK}:{self.port}/{guard.token}/"
        self._server.gui.configure_theme(show_logo=False, show_share_button=False)
        self._server.scene.set_up_direction("+z")
        self._look_at(model, data)
        self.show(model, data)

    def show(self, model: Any, data: Any) -> None:
        """Replace the model."""
        self.model, self.data = model, data
        self._server.scene.reset()
        self._server.gui.reset()
        self.stage = Stage(self._server, model, capture(model, data))
        self.controls = Controls(self._server, self.stage, data, self._look, self._remote)
        known, self._points = self._points, {}
        for name, (body, points, colours, size) in known.items():
            if body in self.stage.names:
                self.show_points(name, body, points, colours, size)

    def _look_at(self, model: Any, data: Any) -> None:
        """Start at the camera of the viewpoint, or so that everything is seen."""
        if self._look.camera:
            self._look_through(model, data, find_camera(model, self._look.camera))
            return
        low, high = scene_extent(model, data)
        middle, away = (low + high) / 2, float(((high - low) ** 2).sum() ** 0.5)
        camera = self._server.initial_camera
        camera.look_at = tuple(middle.tolist())
        camera.position = tuple((middle + away * 0.9 * _DIRECTION).tolist())

    def _look_through(self, model: Any, data: Any, number: int) -> None:
        mujoco.mj_camlight(model, data)
        position, turned = data.cam_xpos[number], data.cam_xmat[number].reshape(3, 3)
        camera = self._server.initial_camera
        camera.position = tuple(position.tolist())
        camera.look_at = tuple((position - turned[:, 2]).tolist())  # it looks along -z
        camera.up = tuple(turned[:, 1].tolist())
        camera.fov = math.radians(float(model.cam_fovy[number]))

    def refresh(self) -> None:
        """Show the current state."""
        with self.controls.lock:
            self.update(capture(self.model, self.data))

    def update(self, seen: VisualState) -> None:
        """Show a visual state of the same model."""
        with self.controls.lock:
            self.data.qpos[:] = seen.positions
            self.stage.update(seen)
            self.controls.tell()

    def show_points(
        self, name: str, body: str, points: Floats, colours: Colours, size: float = 0.004
    ) -> None:
        """Show coloured points on a body, or change their colours: see `Stage.show_points`.

        They remain as long as the body exists, also in another model.
        """
        with self.controls.lock:
            self._points[name] = (body, points, colours, size)
            self.stage.show_points(name, body, points, colours, size)

    def run(self, keep_running: Callable[[], bool] = lambda: True) -> None:
        """Advance time while the page runs, until `keep_running` returns False."""
        last = time.monotonic()
        while keep_running():
            time.sleep(1 / _PICTURES)
            now = time.monotonic()
            passed, last = min(now - last, _MOST_BEHIND), now
            if self.controls.running:
                with self.controls.lock:
                    until = self.data.time + passed
                    while self.data.time < until:
                        mujoco.mj_step(self.model, self.data)
                self.refresh()

    def close(self) -> None:
        """Close the page."""
        self._server.stop()


def _no_tunnel(verbose: bool = True) -> None:
    """Disable all requests to other machines."""


def _free(port: int) -> int:
    """`port` if it is free, or any free one for 0. Raises `OSError`."""
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind((LOOPBACK, port))
        return int(probe.getsockname()[1])

"""Shows the robot in the browser while it is touched; taxels are coloured by their recent force.

In: the running simulation, the skin, its published data. Out: a page on this machine only, until
`close`. Needs the extra `view`.
"""

from __future__ import annotations

import logging
import threading
from typing import Any

import numpy as np
from colours import on_robot
from failure import DemoFailed
from photograph import towards_camera
from recording import Floats, Ints, Skin
from topic_buffer import TopicBuffer

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.simulation.view.live_state import UnsupportedSimulation

HIGHEST = 2.0
"""End of the colour scale [N]."""
_PICTURES = 20.0  # per second
_DOT = 0.006
_DISTANCE = 0.45
_GLOW_S = 0.4
"""How long a touch stays visible, since touches are short."""

log = logging.getLogger("touch_demo")


class Live:
    """The page, open until `close`. `hand` is a proxy of `Simulation`. Raises `DemoFailed`."""

    def __init__(self, name: str, hand: Any, skin: Skin, buffer: TopicBuffer, port: int) -> None:
        try:
            from robocomp_dsl.simulation.view.live import LivePage  # noqa: PLC0415 - an extra
        except ImportError as missing:
            raise DemoFailed(str(missing)) from None
        self._skin, self._buffer = skin, buffer
        try:
            self._page = LivePage(name, hand, port=port)
        except OSError as error:
            raise DemoFailed(f"no page at port {port}: {error.strerror}") from None
        except (UnsupportedSimulation, MiddlewareError) as error:
            raise DemoFailed(f"the simulation cannot be shown: {error}") from None
        self.url = self._page.page.url
        self._shown: dict[str, Any] = {}
        self._look()
        self.show()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, name="page", daemon=True)
        self._thread.start()

    def _look(self) -> None:
        """A camera ahead on the touched side, close enough to see taxels."""
        limb = self._skin.limbs.index(f"{self._buffer.part}/lower_arm")
        page = self._page.page
        middle = page.data.body(self._skin.bodies[limb]).xpos
        camera = page.stage.server.initial_camera
        camera.look_at = tuple(middle.tolist())
        camera.position = tuple((middle + _DISTANCE * towards_camera(middle)).tolist())

    def _run(self) -> None:
        while not self._over.wait(1 / _PICTURES):
            try:
                self._page.refresh()
            except UnsupportedSimulation as error:
                log.warning("the page is not updated: %s", error)
                return
            self.show()

    def show(self) -> None:
        """Colour the taxels; unchanged colours are not sent."""
        force = self._buffer.felt_within(_GLOW_S)
        for name in self._skin.limbs:
            mine = self._skin.of(name)
            colours = _bytes(force[mine])
            if name not in self._shown or not np.array_equal(self._shown[name], colours):
                self._shown[name] = colours
                self._points(name, mine, colours)

    def _points(self, limb: str, mine: Ints, colours: Any) -> None:
        body = self._skin.bodies[self._skin.limbs.index(limb)]
        points = self._skin.placed(limb, self._skin.points[mine])
        self._page.page.show_points(f"skin of {limb}", body, points, colours, _DOT)

    def close(self) -> None:
        """Close the page."""
        self._over.set()
        self._thread.join()
        self._page.close()


def _bytes(force: Floats) -> Any:
    return (255 * on_robot(force, HIGHEST)[:, :3]).astype(np.uint8)

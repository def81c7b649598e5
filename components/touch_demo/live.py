"""The robot in the browser while it is touched, each taxel in the colour of what it feels.

In: the robot's body, what is heard of it, where its other joints are. Out: a page on this machine
alone, until `close`. Needs the extra `view`.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from types import TracebackType
from typing import Any, Self

import numpy as np
from body import Body
from colours import on_robot
from failure import DemoFailed
from heard import Heard
from photograph import towards_camera
from recording import Floats

HIGHEST = 2.0
"""N at the end of the colours."""
_PICTURES = 20.0  # per second
_DOT = 0.006
_DISTANCE = 0.45


class Live:
    """The page; a context manager. `body` belongs to it. Raises `DemoFailed` without viser."""

    def __init__(self, body: Body, heard: Heard, rest: Mapping[str, float], port: int) -> None:
        try:
            from robocomp_dsl.hardware.view.browser import Page  # noqa: PLC0415 - an extra
        except ImportError as missing:
            raise DemoFailed(str(missing)) from None
        self._body, self._heard = body, heard
        body.pose(rest)
        try:
            self._page = Page("touch", body.model, body.data, port=port)
        except OSError as error:
            raise DemoFailed(f"no page at port {port}: {error.strerror}") from None
        self.url = self._page.url
        self._look()
        self._clouds = [self._cloud(i) for i in range(len(body.skin.limbs))]
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, name="page", daemon=True)

    def _look(self) -> None:
        """From ahead and from the touched side, so near that taxels are seen."""
        limb = self._body.skin.limbs.index(f"{self._heard.part}/lower_arm")
        middle = self._body.data.body(self._body.skin.bodies[limb]).xpos
        camera = self._page.stage.server.initial_camera
        camera.look_at = tuple(middle.tolist())
        camera.position = tuple((middle + _DISTANCE * towards_camera(middle)).tolist())

    def _cloud(self, limb: int) -> tuple[Any, Any]:
        """The taxels of a limb as points that move with its body."""
        skin = self._body.skin
        mine = np.flatnonzero(skin.limb == limb)
        number = self._body.model.body(skin.bodies[limb]).id
        name = skin.limbs[limb]
        cloud = self._page.stage.server.scene.add_point_cloud(
            f"{self._page.stage.paths[number]}/skin {name.replace('/', ' ')}",
            points=skin.placed(name, skin.points[mine]).astype(np.float32),
            colors=_bytes(np.zeros(len(mine))),
            point_size=_DOT,
            point_shape="circle",
        )
        return cloud, mine

    def _run(self) -> None:
        while not self._over.wait(1 / _PICTURES):
            self.show()

    def show(self) -> None:
        """Show the latest pose and forces."""
        force = self._heard.force
        with self._page.controls.lock:
            self._body.pose(arm=self._heard.angles, finger=self._heard.finger)
        self._page.refresh()
        for cloud, mine in self._clouds:
            colours = _bytes(force[mine])
            if not np.array_equal(cloud.colors, colours):
                cloud.colors = colours

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """The page is gone."""
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()
        self._page.close()


def _bytes(force: Floats) -> Any:
    return (255 * on_robot(force, HIGHEST)[:, :3]).astype(np.uint8)

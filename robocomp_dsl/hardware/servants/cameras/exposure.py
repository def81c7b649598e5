"""Consecutive pictures of a camera, taken in the background.

In: a camera. Out: its latest picture, once; the next picture is meanwhile taken in another
thread. With simulated time the caller waits, so that every run has the same pictures.
"""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor

from robocomp_dsl.hardware.devices.camera import CameraDevice, Picture


class Exposure:
    """Exposure of one camera."""

    def __init__(self) -> None:
        self._thread: ThreadPoolExecutor | None = None
        self._taken: Future[Picture] | None = None
        self._last_returned: Picture | None = None

    def next(self, camera: CameraDevice, *, wait: bool) -> Picture | None:
        """A picture that has not been returned yet; None if there is none.

        Raises the errors of the camera.
        """
        if wait:
            return self._fresh(camera.picture())
        if self._taken is None:
            self._thread = self._thread or ThreadPoolExecutor(1, thread_name_prefix="exposure")
            self._taken = self._thread.submit(camera.picture)
        if not self._taken.done():
            return None
        taken, self._taken = self._taken, None
        return self._fresh(taken.result())

    def _fresh(self, picture: Picture) -> Picture | None:
        if picture is self._last_returned:
            return None
        self._last_returned = picture
        return picture

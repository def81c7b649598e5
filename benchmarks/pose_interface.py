"""The interface that the middleware is measured with: a pose there, a pose back."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt


class Pose(rt.Struct):
    """Eight doubles and a name: 84 bytes on the wire."""

    stamp: rt.Double = 0.5
    x: rt.Double = 0.5
    y: rt.Double = 0.5
    z: rt.Double = 0.5
    qx: rt.Double = 0.5
    qy: rt.Double = 0.5
    qz: rt.Double = 0.5
    qw: rt.Double = 0.5
    frame: rt.String = "base_frame"


MOVER = rt.Interface("Bench::Mover", rt.Operation("move", inputs={"pose": Pose}, returns=Pose))
TRACK = rt.Interface(
    "Bench::Track", rt.Operation("moved", rt.Pattern.PUBLISH, inputs={"pose": Pose})
)


class MoverProxy(rt.Proxy):
    """As generated."""

    __slots__ = ()
    INTERFACE = MOVER

    def move(self, pose: Pose) -> Pose:
        """Query."""
        return self._call("move", pose)


class TrackProxy(rt.Proxy):
    """As generated."""

    __slots__ = ()
    INTERFACE = TRACK

    def moved(self, pose: Pose) -> None:
        """Publish."""
        self._call("moved", pose)

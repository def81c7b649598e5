"""The interface that the middleware is measured with: a pose there, a pose back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime import types as rt

_NAMES = ("stamp", "x", "y", "z", "qx", "qy", "qz", "qw")


class Pose(rt.Struct):
    """Eight doubles and a name: 84 bytes on the wire."""

    __slots__ = (*_NAMES, "frame")
    _fields_ = (*((name, rt.DOUBLE) for name in _NAMES), ("frame", rt.STRING))

    def __init__(self, *values: float, frame: str = "base_frame") -> None:
        for name, value in zip(_NAMES, values or (0.5,) * len(_NAMES), strict=True):
            setattr(self, name, value)
        self.frame = frame


MOVER = rt.Interface(
    "Bench::Mover", (rt.Operation("move", rt.Pattern.QUERY, (("pose", Pose),), (("", Pose),)),)
)
TRACK = rt.Interface(
    "Bench::Track", (rt.Operation("moved", rt.Pattern.PUBLISH, (("pose", Pose),)),)
)


class MoverProxy(rt.Proxy):
    """As generated."""

    __slots__ = ("_call_move",)
    INTERFACE = MOVER
    _call_move: Callable[..., Pose]

    def _bind(self, bind: Callable[[rt.Operation], Callable[..., Any]]) -> None:
        self._call_move = bind(MOVER.operations[0])

    def move(self, pose: Pose) -> Pose:
        """Query."""
        return self._call_move(pose)


class TrackProxy(rt.Proxy):
    """As generated."""

    __slots__ = ("_call_moved",)
    INTERFACE = TRACK
    _call_moved: Callable[..., None]

    def _bind(self, bind: Callable[[rt.Operation], Callable[..., Any]]) -> None:
        self._call_moved = bind(TRACK.operations[0])

    def moved(self, pose: Pose) -> None:
        """Publish."""
        self._call_moved(pose)

"""Which frames of a scene move freely: those with physics that nothing else moves.

In: frames by id. Out: whether a frame falls, and the frame that carries another one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from robocomp_dsl.hardware.description.scene import ROOT, Frame


def falls(frame: Frame, frames: Mapping[str, Frame]) -> bool:
    """Whether `frame` has physics and no frame above it moves."""
    return frame.physics and not any(_moves(above) for above in _above(frame, frames))


def loads(frames: Iterable[Frame]) -> frozenset[str]:
    """The frames that are fixed to a falling one and weigh on it; `frames` follow their parents."""
    known = {frame.id: frame for frame in frames}
    fixed: set[str] = set()
    for frame in known.values():
        is_fixed = frame.motion is None and not frame.drives
        if falls(frame, known) or (is_fixed and frame.parent in fixed):
            fixed.add(frame.id)
    return frozenset(fixed)


def carrier(frame: str, frames: Mapping[str, Frame]) -> str:
    """The nearest base or falling frame from `frame` upwards; else `frame`."""
    start = frames[frame]
    for holder in (start, *_above(start, frames)):
        if holder.drives or falls(holder, frames):
            return holder.id
    return frame


def _above(frame: Frame, frames: Mapping[str, Frame]) -> list[Frame]:
    """The frames above `frame`, without the root."""
    found = []
    while frame.parent not in {"", ROOT}:
        frame = frames[frame.parent]
        found.append(frame)
    return found


def _moves(frame: Frame) -> bool:
    """Whether something moves the frame in its parent. A frame with physics below it is its load.

    Bodies of a model file move by the joints above them.
    """
    joint = frame.model_part == "joint"
    return joint or frame.motion is not None or frame.drives or frame.physics

"""Data published by a robot, its arm and its reflex, in order of arrival.

In: published structs, on any thread. Out: their numbers in the form of a recording.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

import numpy as np
from recording import Answer, Floats, Press, Recording, Skin

_FROZEN = "Frozen"
_BACK_S = 1.0
"""Maximum delay of a message; a larger step back in time is a reset."""


class TopicBuffer:
    """Notifies `changed` about data of `part`; stores all or the `capacity` latest of a kind."""

    def __init__(self, skin: Skin, part: str, capacity: int | None = None) -> None:
        limbs = [i for i, name in enumerate(skin.limbs) if name.startswith(f"{part}/")]
        self.changed = threading.Condition()
        self._skin, self.part = skin, part
        self._mine = np.isin(skin.limb, limbs)
        self._frames: deque[tuple[float, Floats]] = deque(maxlen=capacity)
        self._arm: deque[tuple[float, Floats, bool]] = deque(maxlen=capacity)
        self._fingers: deque[tuple[float, Floats]] = deque(maxlen=capacity)
        self._answers: deque[Answer] = deque(maxlen=capacity)
        self._frozen = float("-inf")
        self.free_since = float("inf")
        """Time since which the arm's skin has felt nothing; infinite while it feels something."""

    # Handlers of the middleware.

    def frame(self, frame: Any) -> None:
        """`SkinFrame`; frames of another length are ignored."""
        force = np.array(frame.force, dtype=np.float64)
        if len(force) != len(self._mine):
            return
        with self.changed:
            self._from(float(frame.time))
            self._frames.append((float(frame.time), force))
            if force[self._mine].any():
                self.free_since = float("inf")
            elif self.free_since == float("inf"):
                self.free_since = float(frame.time)
            self.changed.notify_all()

    def arm_state(self, state: Any) -> None:
        """`GenericArmState`."""
        with self.changed:
            self._from(float(state.time))
            angles = np.array(state.position, dtype=np.float64)
            self._arm.append((float(state.time), angles, bool(state.moving)))
            self.changed.notify_all()

    def answer(self, event: Any) -> None:
        """`ReflexEvents`."""
        with self.changed:
            response = Answer(float(event.time), event.field, float(event.gain), float(event.force))
            self._answers.append(response)
            self.changed.notify_all()

    def reflex_state(self, state: Any) -> None:
        """`ReflexEvents`: the new state of the reflex."""
        with self.changed:
            if state.name == _FROZEN and self._frames:
                self._frozen = self.now

    def finger_at(self, time: float, joints: Floats) -> None:
        """Store a position of the finger."""
        with self.changed:
            if not self._fingers or time > self._fingers[-1][0]:
                self._fingers.append((time, joints))

    def _from(self, time: float) -> None:
        """After a reset of the simulation, discard all but the latest data."""
        if not (self._frames and self._arm and time < self.now - _BACK_S):
            return
        self._frames = deque([(time, self._frames[-1][1])], self._frames.maxlen)
        self._arm = deque([(time, *self._arm[-1][1:])], self._arm.maxlen)
        self._fingers.clear()
        self._answers.clear()
        self._frozen = float("-inf")

    # Queries.

    @property
    def complete(self) -> bool:
        """Whether data of skin and arm have arrived."""
        return bool(self._frames and self._arm)

    @property
    def now(self) -> float:
        """The latest simulated time in s."""
        return max(self._frames[-1][0], self._arm[-1][0])

    def felt_within(self, seconds: float) -> Floats:
        """The maximum force on each taxel within the last seconds, (n,) in N."""
        with self.changed:
            since = self._frames[-1][0] - seconds
            latest = [force for time, force in self._frames if time >= since]
        felt: Floats = np.max(latest, axis=0)
        return felt

    @property
    def angles(self) -> Floats:
        """The latest generic angles (5,)."""
        return self._arm[-1][1]

    @property
    def finger_seen(self) -> float:
        """Time of the latest finger position, in s."""
        return self._fingers[-1][0] if self._fingers else float("-inf")

    def frozen_since(self, time: float) -> bool:
        """Whether the reflex was frozen after that time."""
        return self._frozen >= time

    @property
    def finger(self) -> Floats:
        """The latest position of the finger, (3,)."""
        return self._fingers[-1][1]

    def is_at_rest(self, seconds: float, way: float) -> bool:
        """Whether the arm has moved by at capacity `way` rad within the last seconds."""
        with self.changed:
            latest = [sample for sample in self._arm if sample[0] >= self._arm[-1][0] - seconds]
        if latest[-1][2] or latest[-1][0] - latest[0][0] < 0.5 * seconds:
            return False
        return bool(np.ptp([angles for _, angles, _ in latest], axis=0).max() <= way)

    def recording(self, robot: str, presses: list[Press], **others: Any) -> Recording:
        """All data; `others` are the other fields of a `Recording`."""
        with self.changed:
            frames, arm, fingers = list(self._frames), list(self._arm), list(self._fingers)
            answers = tuple(self._answers)
        return Recording(
            robot=robot,
            part=self.part,
            skin=self._skin,
            presses=tuple(presses),
            answers=answers,
            frame_time=np.array([time for time, _ in frames]),
            force=np.array([force for _, force in frames]),
            arm_time=np.array([sample[0] for sample in arm]),
            arm=np.array([sample[1] for sample in arm]),
            finger_time=np.array([time for time, _ in fingers]),
            finger=np.array([joints for _, joints in fingers]),
            **others,
        )


def skin_of(geometry: Any) -> Skin:
    """The geometry of a skin as arrays."""
    limbs = geometry.limbs
    turns = [[getattr(limb, f"r{i}{j}") for i in range(3) for j in range(3)] for limb in limbs]
    return Skin(
        points=np.column_stack((geometry.x, geometry.y, geometry.z)).astype(np.float64),
        normals=np.column_stack((geometry.nx, geometry.ny, geometry.nz)).astype(np.float64),
        limb=np.array(geometry.limb, dtype=np.int64),
        limbs=tuple(limb.name for limb in limbs),
        bodies=tuple(limb.body for limb in limbs),
        origins=np.array([(limb.x, limb.y, limb.z) for limb in limbs]).reshape(-1, 3),
        axes=np.array(turns).reshape(-1, 3, 3),
    )

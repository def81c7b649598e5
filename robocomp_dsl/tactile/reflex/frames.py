"""Which taxel frames may be used: a gate that rejects and counts all others.

In: frames as they arrive, in whatever order and shape. Out: forces (n,) of good frames, in newtons,
or `RejectedFrame`. A publisher that starts anew is known by later times; one whose clock starts
anew too is believed again after `forget`.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import FrameFault, RejectedFrame


@dataclass(slots=True)
class FrameGate:
    """For frames of `size` taxels of one geometry `version`, None: it is not known yet.

    `rejected` counts by reason. `other` is the version of the latest frame, where that is another.
    """

    version: int | None = None
    size: int = 0
    accepted: int = 0
    rejected: Counter[FrameFault] = field(default_factory=Counter)
    other: int | None = None
    _sequence: int = -1
    _time: float = -np.inf

    def expect(self, version: int, size: int) -> None:
        """From now on frames of this geometry; what was counted stays."""
        self.version, self.size, self.other = version, size, None

    def check(self, sequence: int, time: float, version: int, values: Floats) -> Floats:
        """The forces of a good frame, none of them negative. Raises `RejectedFrame`."""
        self.other = version if version != self.version else None
        fault, detail = self._fault(sequence, time, version, values)
        if fault is not None:
            self.rejected[fault] += 1
            raise RejectedFrame(fault, detail)
        self.accepted += 1
        self._sequence, self._time = sequence, time
        return np.maximum(values, 0.0)

    @property
    def behind(self) -> bool:
        """Whether the latest frame belongs to a newer geometry than this gate knows."""
        return self.other is not None and (self.version is None or self.other > self.version)

    def forget(self) -> None:
        """Take the next frame whatever its number: its publisher may have started anew."""
        self._sequence, self._time = -1, -np.inf

    def _fault(
        self, sequence: int, time: float, version: int, values: Floats
    ) -> tuple[FrameFault | None, str]:
        if version != self.version:
            known = "none is known yet" if self.version is None else f"not {self.version}"
            return FrameFault.OTHER_GEOMETRY, f"{version}, {known}"
        if values.shape != (self.size,):
            return FrameFault.WRONG_LENGTH, f"{values.size} values, not {self.size}"
        if not (np.isfinite(time) and np.isfinite(values).all()):
            return FrameFault.NOT_FINITE, f"frame {sequence}"
        if sequence <= self._sequence and time <= self._time:
            return FrameFault.OUT_OF_ORDER, f"frame {sequence} after {self._sequence}"
        return None, ""

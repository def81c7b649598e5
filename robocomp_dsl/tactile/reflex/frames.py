"""Validation of taxel frames: rejects and counts frames that must not be used.

In: frames in any order and shape. Out: forces (n,) of valid frames in newtons, or `RejectedFrame`.
A restarted publisher is accepted because its times are later. If its clock restarted as well, call
`reset_sequence`.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import FrameFault, RejectedFrame


@dataclass(slots=True)
class FrameValidator:
    """Validates frames of `size` taxels of geometry `version` (None: not known yet).

    `rejected` counts by reason. `other_version` is the version of the latest frame if it differs.
    """

    version: int | None = None
    size: int = 0
    accepted: int = 0
    rejected: Counter[FrameFault] = field(default_factory=Counter)
    other_version: int | None = None
    _sequence: int = -1
    _time: float = -np.inf

    def expect(self, version: int, size: int) -> None:
        """Expect frames of this geometry from now on. The counts are not reset."""
        self.version, self.size, self.other_version = version, size, None

    def check(self, sequence: int, time: float, version: int, values: Floats) -> Floats:
        """The forces of a valid frame, clipped at 0. Raises `RejectedFrame`."""
        self.other_version = version if version != self.version else None
        fault, detail = self._fault(sequence, time, version, values)
        if fault is not None:
            self.rejected[fault] += 1
            raise RejectedFrame(fault, detail)
        self.accepted += 1
        self._sequence, self._time = sequence, time
        return np.maximum(values, 0.0)

    @property
    def is_outdated(self) -> bool:
        """Whether the latest frame belongs to a newer geometry than the expected one."""
        return self.other_version is not None and (
            self.version is None or self.other_version > self.version
        )

    def reset_sequence(self) -> None:
        """Accept the next frame with any sequence number, for a publisher that restarted."""
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

"""The noise level of a world: a factor on the declared noise of all sensors."""

from __future__ import annotations

from robocomp_dsl.hardware.devices.errors import CommandRefused, require_finite


class NoiseLevel:
    """1: as declared, 0: none. Shared by all devices of a world."""

    def __init__(self, factor: float = 1.0) -> None:
        self.factor = 1.0
        self.set(factor)

    def set(self, factor: float) -> None:
        """Set the level. Raises `CommandRefused` for negative values and NaN."""
        require_finite(noise=factor)
        if factor < 0:
            raise CommandRefused(f"`noise` is {factor:g}, it cannot be negative")
        self.factor = factor

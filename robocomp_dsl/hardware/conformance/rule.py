"""Conformance rules, and the checks that raise `Violation`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Advance = Callable[[float], None]
"""Lets so many seconds pass in the world of the device."""


class Violation(AssertionError):
    """A device does not keep to a rule; the message says how."""


@dataclass(frozen=True, slots=True)
class ConformanceRule:
    """`holds(device, advance)` raises `Broken`. A rule that `moves` the robot needs room for it."""

    check: Callable[[Any, Advance], None]
    moves_robot: bool = False

    @property
    def name(self) -> str:
        """Its name in plain words."""
        return self.check.__name__

    def __str__(self) -> str:
        return self.name


def rules(*still: Callable[[Any, Advance], None]) -> tuple[ConformanceRule, ...]:
    """Rules that move nothing."""
    return tuple(ConformanceRule(check) for check in still)


def require(condition: object, message: str) -> None:
    """Pass where the condition holds; else raise `Broken`."""
    if not condition:
        raise Violation(message)


def finite(name: str, values: object) -> None:
    """Pass where all values are finite numbers."""
    require(np.isfinite(np.asarray(values, dtype=float)).all(), f"`{name}` is not finite: {values}")


def require_later(name: str, before: float, after: float) -> None:
    """Raise `Violation` unless time has advanced."""
    require(after > before, f"the time of `{name}` does not go on: {before} s, then {after} s")

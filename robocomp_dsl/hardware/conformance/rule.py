"""Conformance rules, and the checks that raise `Violation`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Advance = Callable[[float], None]
"""Advances the world of the device by a number of seconds."""


class Violation(AssertionError):
    """A device violates a rule; the message describes the violation."""


@dataclass(frozen=True, slots=True)
class ConformanceRule:
    """`holds(device, advance)` raises `Violation`. A rule that `moves` needs free space."""

    check: Callable[[Any, Advance], None]
    moves_robot: bool = False

    @property
    def name(self) -> str:
        """The name in plain words."""
        return self.check.__name__

    def __str__(self) -> str:
        return self.name


def rules(*still: Callable[[Any, Advance], None]) -> tuple[ConformanceRule, ...]:
    """Rules without motion."""
    return tuple(ConformanceRule(check) for check in still)


def require(condition: object, message: str) -> None:
    """Raise `Violation` unless the condition holds."""
    if not condition:
        raise Violation(message)


def finite(name: str, values: object) -> None:
    """Raise `Violation` unless all values are finite."""
    require(np.isfinite(np.asarray(values, dtype=float)).all(), f"`{name}` is not finite: {values}")


def require_later(name: str, before: float, after: float) -> None:
    """Raise `Violation` unless time has advanced."""
    require(after > before, f"the time of `{name}` does not go on: {before} s, then {after} s")

"""What a rule is, and how its breach is told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Pass = Callable[[float], None]
"""Lets so many seconds pass in the world of the device."""


class Broken(AssertionError):
    """A device does not keep to a rule; the message says how."""


@dataclass(frozen=True, slots=True)
class Rule:
    """`holds(device, passes)` raises `Broken`. A rule that `moves` the robot needs room for it."""

    holds: Callable[[Any, Pass], None]
    moves: bool = False

    @property
    def name(self) -> str:
        """What it says, in short."""
        return self.holds.__name__

    def __str__(self) -> str:
        return self.name


def rules(*still: Callable[[Any, Pass], None]) -> tuple[Rule, ...]:
    """Rules that move nothing."""
    return tuple(Rule(one) for one in still)


def must(condition: object, message: str) -> None:
    """Pass where the condition holds; else raise `Broken`."""
    if not condition:
        raise Broken(message)


def finite(name: str, values: object) -> None:
    """Pass where all values are finite numbers."""
    must(np.isfinite(np.asarray(values, dtype=float)).all(), f"`{name}` is not finite: {values}")


def later(name: str, before: float, after: float) -> None:
    """Pass where time has gone on."""
    must(after > before, f"the time of `{name}` does not go on: {before} s, then {after} s")

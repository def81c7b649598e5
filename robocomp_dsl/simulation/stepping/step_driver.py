"""Protocols of a simulated world and of the driver that advances its time."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.servants.fair_lock import FairLock


class Steppable(Protocol):
    """A world that a driver can step. Hold `lock` for all other members."""

    failure: str

    @property
    def lock(self) -> FairLock:
        """The lock that guards the world."""

    @property
    def time(self) -> float:
        """Simulated seconds."""

    @property
    def dt(self) -> float:
        """Physics time step [s]."""

    @property
    def time_to_next_step(self) -> float:
        """Simulated seconds to the next step."""

    def advance(self, seconds: float) -> None:
        """Advance time. Raises `Diverged`."""

    def reset_state(self) -> None:
        """Reset the state to the start; keep the clock."""

    def dispatch_events(self) -> None:
        """Call the subscribers of new events, without holding `lock`."""


class StepDriver(Protocol):
    """Advances a world. `speed` is in simulated seconds per second, 0: as fast as possible.

    Call the operations without holding the lock, except `on_reset`.
    """

    @property
    def speed(self) -> float:
        """The requested speed."""

    @property
    def real_time_factor(self) -> float:
        """The measured ratio of simulated to wall time."""

    @property
    def paused(self) -> bool:
        """Whether time is paused."""

    def validate_speed(self, speed: float) -> str:
        """The reason why this speed is invalid; empty if it is valid."""

    def set_speed(self, speed: float) -> None:
        """Set the requested speed. Raises `CommandRefused`."""

    def pause(self) -> None:
        """Pause time."""

    def resume(self) -> None:
        """Resume time."""

    def step(self, seconds: float) -> None:
        """While paused, advance by `seconds`. Raises `CommandRefused`."""

    def on_reset(self, seconds: float) -> None:
        """The world has been reset to this time."""

    def update(self) -> None:
        """Called in every period of the component."""

    def start(self) -> None:
        """Start to advance time."""

    def stop(self) -> None:
        """Stop advancing time."""

"""What a world is to that which paces it, and what its pace is to those who hold it.

In: nothing. Out: the two Protocols.
"""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.turns import Turns


class Paced(Protocol):
    """The world. All but `turns` under `turns`."""

    failure: str

    @property
    def turns(self) -> Turns:
        """Who may touch it."""

    @property
    def time(self) -> float:
        """Simulated seconds."""

    @property
    def dt(self) -> float:
        """Length of one step of the physics in s."""

    @property
    def left(self) -> float:
        """Simulated seconds to the next step."""

    def advance(self, seconds: float) -> None:
        """Let time pass. Raises `Diverged`."""

    def renew(self) -> None:
        """Everything as it was at the start, but for the clock."""

    def tell(self) -> None:
        """Let others hear of what has happened; not under `turns`."""


class Pace(Protocol):
    """`speed` in simulated seconds per second, 0: as fast as it can; `factor` is what it comes to.

    Operations are called without holding the turn, but `anew`.
    """

    @property
    def speed(self) -> float:
        """As it is wished."""

    @property
    def factor(self) -> float:
        """As it is."""

    @property
    def paused(self) -> bool:
        """Whether time stands still."""

    def refusal(self, speed: float) -> str:
        """Why it cannot have this speed; empty where it can."""

    def set_speed(self, speed: float) -> None:
        """Raises `CommandRefused`."""

    def pause(self) -> None:
        """Time stands still."""

    def resume(self) -> None:
        """Time goes on."""

    def step(self, seconds: float) -> None:
        """While it is paused, let so much time pass, at once. Raises `CommandRefused`."""

    def anew(self, seconds: float) -> None:
        """The world has begun anew, at this time."""

    def keep_up(self) -> None:
        """Called in every period of the component."""

    def start(self) -> None:
        """Time begins."""

    def stop(self) -> None:
        """Time ends."""

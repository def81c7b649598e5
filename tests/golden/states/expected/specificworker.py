"""states: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """Plays a game."""

    def initialize(self) -> None:
        """Once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Every 100 ms."""

    # The states of game.smdsl. There may also be on_enter_… and on_exit_… methods;
    # self.machine.go("event") leads from one state to another.

    def state_waiting(self) -> None:
        """Every period while `waiting` is active."""

    def state_playing(self) -> None:
        """Every period while `playing` is active."""

    def state_music(self) -> None:
        """Every period while `music` is active."""

    def state_moves(self) -> None:
        """Every period while `moves` is active."""

    def state_paused(self) -> None:
        """Every period while `paused` is active."""

    def state_over(self) -> None:
        """Every period while `over` is active."""

"""states: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from states_generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """Plays a game."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""

    # The states of game.smdsl. Methods on_enter_… and on_exit_… are optional;
    # self.machine.send("event") triggers a transition.

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

"""chart: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from chart_generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """The component chart."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    # The states of door.scxml. Methods on_enter_… and on_exit_… are optional;
    # self.machine.send("event") triggers a transition.

    def state_closed(self) -> None:
        """Every period while `closed` is active."""

    def state_open(self) -> None:
        """Every period while `open` is active."""

    def state_wide(self) -> None:
        """Every period while `wide` is active."""

    def state_a_jar(self) -> None:
        """Every period while `a-jar` is active."""

    def state_broken(self) -> None:
        """Every period while `broken` is active."""

"""chart: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """The component chart."""

    def initialize(self) -> None:
        """Once at the start; the parameters are in self.params."""

    # The states of door.scxml. There may also be on_enter_… and on_exit_… methods;
    # self.machine.go("event") leads from one state to another.

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

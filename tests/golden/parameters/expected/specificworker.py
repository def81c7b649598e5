"""arm: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from arm_generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """The component arm."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 1 ms."""

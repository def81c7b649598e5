"""my_empty: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """The component my_empty."""

    def initialize(self) -> None:
        """Once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Every 100 ms."""

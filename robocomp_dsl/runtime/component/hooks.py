"""The hooks of a component: what its user writes, and its lifecycle calls."""

from __future__ import annotations

from typing import Protocol


class Hooks(Protocol):
    """The methods that the lifecycle calls."""

    def initialize(self) -> None:
        """Called once, before anything else."""

    def compute(self) -> None:
        """Called every period."""

    def emergency(self) -> None:
        """Called every period of an emergency."""

    def restore(self) -> None:
        """Called before leaving an emergency."""

    def finalize(self) -> None:
        """Called once, at the end."""

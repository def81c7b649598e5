"""A value that does not fit into the message that a bridge builds."""

from __future__ import annotations


class DoesNotFit(ValueError):
    """A value with the wrong length or range; `path` is the field of the message."""

    def __init__(self, path: str, reason: str) -> None:
        super().__init__(path, reason)
        self.path = path
        self.reason = reason

    def __str__(self) -> str:
        return f"{self.path}: {self.reason}" if self.path else self.reason

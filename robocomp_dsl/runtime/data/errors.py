"""The error for a Python value that its type cannot carry."""

from __future__ import annotations


class EncodeError(ValueError):
    """A value that its type cannot carry; nothing was sent. `path` is the field it was given to."""

    def __init__(self, reason: str, path: str = "") -> None:
        self.reason = reason
        self.path = path
        super().__init__(reason, path)

    def __str__(self) -> str:
        return f"{self.path}: {self.reason}" if self.path else self.reason

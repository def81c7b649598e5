"""What generation gives: files as data, before anything is written."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class OutputFile:
    """One file. `path` is relative to the output folder, with `/`.

    A file with `keep` is written once and then belongs to the user.
    """

    path: str
    text: str
    keep: bool = False

    @property
    def data(self) -> bytes:
        """Its bytes on the disk."""
        return self.text.encode()

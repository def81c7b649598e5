"""What generation gives: files as data, before anything is written."""

from __future__ import annotations

from robocomp_dsl.record import Value

RECORD = ".rcgen/"
"""The folder in which rcgen remembers what it generated."""


class OutputFile(Value):
    """One file. `path` is relative to the output folder, with `/`.

    A file with `keep` is written once and then belongs to the user. One that was made from a file
    of the user has the bytes of that in `seen`: it is only written over those.
    """

    path: str
    text: str
    keep: bool = False
    encoding: str = "utf-8"
    seen: bytes | None = None

    @property
    def own(self) -> bool:
        """Whether it is rcgen's record of what it did, which nobody needs to look at."""
        return self.path.startswith(RECORD)

    @property
    def data(self) -> bytes:
        """Its bytes on the disk."""
        return self.text.encode(self.encoding, "surrogateescape")

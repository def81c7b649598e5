"""What generation gives: files as data, before anything is written."""

from __future__ import annotations

from robocomp_dsl.record import ValueRecord

MANIFEST_FOLDER = ".rcgen/"
"""The folder in which rcgen remembers what it generated."""


class OutputFile(ValueRecord):
    """One file. `path` is relative to the output folder, with `/`.

    A file with `keep` is written once and then belongs to the user. One that was made from a file
    that is there already has the bytes of that in `seen`: it is only written over those. One that
    `is_removed` is deleted if it still holds the bytes in `seen`.
    """

    path: str
    text: str
    write_once: bool = False
    encoding: str = "utf-8"
    expected_bytes: bytes | None = None
    is_removed: bool = False

    @property
    def is_internal(self) -> bool:
        """Whether it is rcgen's record of what it did, which nobody needs to look at."""
        return self.path.startswith(MANIFEST_FOLDER)

    @property
    def data(self) -> bytes:
        """Its bytes on the disk."""
        return self.text.encode(self.encoding, "surrogateescape")

"""Generated files as data, before anything is written."""

from __future__ import annotations

from robocomp_dsl.record import ValueRecord

MANIFEST_FOLDER = ".rcgen/"
"""The folder of rcgen's manifest and pristine outputs."""


class OutputFile(ValueRecord):
    """One file. `path` is relative to the output folder, with `/`.

    A file with `write_once` is written once and then belongs to the user. A merged file has the
    bytes of the existing file in `expected_bytes`: only these are overwritten. A file with
    `is_removed` is deleted if it still has the expected bytes.
    """

    path: str
    text: str
    write_once: bool = False
    encoding: str = "utf-8"
    expected_bytes: bytes | None = None
    is_removed: bool = False

    @property
    def is_internal(self) -> bool:
        """Whether it is internal data of rcgen."""
        return self.path.startswith(MANIFEST_FOLDER)

    @property
    def data(self) -> bytes:
        """The bytes to write."""
        return self.text.encode(self.encoding, "surrogateescape")

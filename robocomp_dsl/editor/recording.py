"""Which files a check looked at, so that a change of one of them checks this one again.

In: the questions of the checks. Out: the answers of `Files`, and which files were asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from robocomp_dsl.check.files import Files, identity
from robocomp_dsl.source import Source


class RecordingFiles(Files):
    """`Files` that remember what was asked, also for files that are not there (yet)."""

    def __init__(self) -> None:
        super().__init__()
        self._asked: set[str] | None = None

    @contextmanager
    def recording(self) -> Iterator[set[str]]:
        """A set that fills with the identities of the files that are looked at meanwhile."""
        asked: set[str] = set()
        self._asked = asked
        try:
            yield asked
        finally:
            self._asked = None

    def adopt(self, path: Path, other: Files) -> None:
        """Take over the buffer at `path` and its tree from other files."""
        key = identity(path)
        self._buffers[key] = other._buffers[key]
        self._parsed.update({k: kept for k, kept in other._parsed.items() if k[0] == key})

    def exists(self, path: Path) -> bool:
        """As in `Files`."""
        self._note(path)
        return super().exists(path)

    def read(self, path: Path) -> Source:
        """As in `Files`."""
        self._note(path)
        return super().read(path)

    def _note(self, path: Path) -> None:
        if self._asked is not None:
            self._asked.add(identity(path))

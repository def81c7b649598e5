"""Records which files a check reads, so that a change of one of them triggers a new check.

In: the calls of the checks. Out: the results of `Files`, and the set of files that were accessed.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from robocomp_dsl.check.workspace.source_cache import SourceCache, canonical_path
from robocomp_dsl.source import Source


class DependencyTracker(SourceCache):
    """`Files` that record every access, also to files that do not exist (yet)."""

    def __init__(self) -> None:
        super().__init__()
        self._dependencies: set[str] | None = None

    @contextmanager
    def track(self) -> Iterator[set[str]]:
        """Yield a set that collects the canonical paths of the files accessed in the block."""
        dependencies: set[str] = set()
        self._dependencies = dependencies
        try:
            yield dependencies
        finally:
            self._dependencies = None

    def copy_buffer(self, path: Path, other: SourceCache) -> None:
        """Copy the buffer at `path` and its tree from `other`."""
        key = canonical_path(path)
        self._overlays[key] = other._overlays[key]
        self._parsed.update({k: parsed for k, parsed in other._parsed.items() if k[0] == key})

    def exists(self, path: Path) -> bool:
        """As in `Files`."""
        self._record(path)
        return super().exists(path)

    def read(self, path: Path) -> Source:
        """As in `Files`."""
        self._record(path)
        return super().read(path)

    def _record(self, path: Path) -> None:
        if self._dependencies is not None:
            self._dependencies.add(canonical_path(path))

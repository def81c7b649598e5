"""Remembers the SHA-256 of files by size, times of change and inode.

In: paths with their status. Out: hashes; a file is read only if it changed. The cache is a file in
the user's cache folder; if it is lost or damaged, files are read again.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import stat
import tempfile
import time
from pathlib import Path

from robocomp_dsl.regular_file import open_regular

_SETTLED_NS = 2_000_000_000
"""A file that changed this recently may change again within one tick of its clock [ns]."""
_CHUNK = 1 << 20
_VERSION = 1

_MOST_FILES = 200_000
"""A larger cache forgets the files that were not asked for in this run."""

Identity = tuple[int, int, int, int]
"""Size [bytes], times of the last change of content and of status [ns], and inode."""


def cache_folder() -> Path:
    """The folder of rcdeploy in the user's cache."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "robocomp"


class HashCache:
    """The hashes of files. `save` stores them; `reads` counts the files that were read."""

    def __init__(self, path: Path | None = None) -> None:
        """`path` None: the file in the user's cache folder."""
        self._path = path or cache_folder() / "hashes.json"
        self._known = _load(self._path)
        self._changed = False
        self._used: set[str] = set()
        self.reads = 0

    def sha256(self, name: str, status: os.stat_result) -> str:
        """The hash of the regular file at the absolute path `name`. Raises `OSError`."""
        identity = (status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino)
        self._used.add(name)
        entry = self._known.get(name)
        if entry and entry[0] == identity:
            return entry[1]
        digest = _hash_file(Path(name))
        self.reads += 1
        if time.time_ns() - max(status.st_mtime_ns, status.st_ctime_ns) > _SETTLED_NS:
            self._known[name] = (identity, digest)
            self._changed = True
        return digest

    def save(self) -> None:
        """Store new hashes; a cache that cannot be written is no error."""
        if not self._changed:
            return
        if len(self._known) > _MOST_FILES:
            self._known = {name: self._known[name] for name in self._used & self._known.keys()}
        data = [[path, *identity, digest] for path, (identity, digest) in self._known.items()]
        draft = ""
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            descriptor, draft = tempfile.mkstemp(dir=self._path.parent, prefix=".hashes-")
            with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
                json.dump({"version": _VERSION, "files": data}, stream, separators=(",", ":"))
            Path(draft).replace(self._path)
            self._changed = False
        except (OSError, UnicodeEncodeError):
            if draft:
                with contextlib.suppress(OSError):
                    Path(draft).unlink()


def _hash_file(path: Path) -> str:
    digest = hashlib.sha256()
    with open_regular(path) as stream:
        while chunk := stream.read(_CHUNK):
            digest.update(chunk)
    return digest.hexdigest()


def _load(path: Path) -> dict[str, tuple[Identity, str]]:
    try:
        if not stat.S_ISREG(path.lstat().st_mode):
            return {}
        data = json.loads(path.read_bytes())
        if data["version"] != _VERSION:
            return {}
        return {
            name: ((size, changed, status_changed, inode), digest)
            for name, size, changed, status_changed, inode, digest in data["files"]
        }
    except (OSError, ValueError, KeyError, TypeError):
        return {}

"""Bounds the log files below a folder: `python -m … FOLDER BYTES`, run by a timer.

It punches holes at the start of files (fallocate(2)), so that all offsets stay as they are: a
reader goes on where it was. A file system that cannot do so gets shorter files instead.
"""

from __future__ import annotations

import ctypes
import os
import sys
from contextlib import suppress
from pathlib import Path

MIN_BYTES = 1_000_000
"""What every file may keep."""
_PUNCH_HOLE = 0x02 | 0x01
"""FALLOC_FL_PUNCH_HOLE with FALLOC_FL_KEEP_SIZE."""
_BLOCK = 4096


def trim_folder(folder: Path, limit: int) -> None:
    """Let the files below `folder` use at most about `limit` bytes of the disk together."""
    files = [path for path in folder.rglob("*.log") if path.is_file() and not path.is_symlink()]
    share = max(limit // max(len(files), 1), MIN_BYTES)
    for path in files:
        with suppress(OSError):
            trim_file(path, share)


def trim_file(path: Path, limit: int) -> None:
    """Keep about the last `limit` bytes of `path`. Raises `OSError`."""
    with path.open("r+b") as file:
        status = os.fstat(file.fileno())
        if status.st_blocks * 512 <= limit:
            return
        # Half of it, so that the next time is not soon.
        length = (status.st_size - limit // 2) // _BLOCK * _BLOCK
        if length > 0 and not _punch(file.fileno(), length):
            file.truncate(0)


def _punch(descriptor: int, length: int) -> bool:
    libc = ctypes.CDLL(None, use_errno=True)
    offsets = (ctypes.c_int64(0), ctypes.c_int64(length))
    return bool(libc.fallocate64(descriptor, _PUNCH_HOLE, *offsets) == 0)


if __name__ == "__main__":
    trim_folder(Path(sys.argv[1]), int(sys.argv[2]))

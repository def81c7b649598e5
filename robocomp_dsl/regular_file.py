"""Opens files that a user names, without waiting for a pipe or reading a device without end.

In: a path. Out: the content of a regular file. Anything else (a FIFO, a socket, a device, a folder)
is an `OSError` whose `strerror` says what the path is.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path
from typing import BinaryIO

_KINDS = {
    stat.S_IFIFO: "it is a FIFO, not a regular file",
    stat.S_IFSOCK: "it is a socket, not a regular file",
    stat.S_IFCHR: "it is a device, not a regular file",
    stat.S_IFBLK: "it is a device, not a regular file",
}


def open_regular(path: Path) -> BinaryIO:
    """The file at `path`, open for reading.

    Raises `OSError` (`IsADirectoryError` for a folder) if it is no regular file, and `ValueError`
    for a path with a null character.
    """
    # Without O_NONBLOCK, opening a FIFO waits until another process writes to it.
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
    mode = os.fstat(descriptor).st_mode
    if stat.S_ISREG(mode):
        return os.fdopen(descriptor, "rb")
    os.close(descriptor)
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    raise OSError(errno.EINVAL, _KINDS[stat.S_IFMT(mode)], str(path))


def read_bytes(path: Path) -> bytes:
    """The content of the regular file at `path`. Raises as `open_regular`."""
    with open_regular(path) as stream:
        return stream.read()


def read_text(path: Path, encoding: str = "utf-8") -> str:
    """The text of a regular file. Raises as `open_regular`, and `UnicodeDecodeError`."""
    return read_bytes(path).decode(encoding).replace("\r\n", "\n").replace("\r", "\n")

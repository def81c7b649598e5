"""Replaces a file of the user. In: a path and a text. Out: the old or the new file, as a whole."""

from __future__ import annotations

from pathlib import Path


class FileNotReplaced(Exception):
    """The file cannot be written; the message says why."""


def write_text(path: Path, text: str) -> None:
    """Write `text` with the mode of the existing file. Raises `FileNotReplaced`."""
    try:
        new = path.with_name(f".{path.name}.new")
        new.write_bytes(text.encode("utf-8"))
        new.chmod(path.stat().st_mode & 0o777)
        new.replace(path)
    except OSError as error:
        raise FileNotReplaced(f"{path} cannot be written: {error.strerror}") from None

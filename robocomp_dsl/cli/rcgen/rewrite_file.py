"""Rewrites files of the user in place, for `check --fix` and `fmt`.

In: a path and its new text. Out: the file rewritten atomically, or the difference as text.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import write
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.source import declare_utf8

BOM = "\N{ZERO WIDTH NO-BREAK SPACE}"


def rewrite_file(path: Path, text: str) -> None:
    """Write `text` to the file at `path`; a BOM is kept, the encoding is UTF-8.

    Raises `CannotWrite`.
    """
    mark = BOM if read_bytes(path).startswith(BOM.encode()) else ""
    # Write the target of a symbolic link, so that the link stays.
    real = path.resolve()
    write(real.parent, [OutputFile(real.name, mark + declare_utf8(text))])


def unified_diff(path: Path, old: str, new: str) -> str:
    """The unified difference of two texts, or nothing."""
    from difflib import unified_diff  # noqa: PLC0415 - only when it is asked for

    a, b = (text.splitlines(keepends=True) for text in (old, new))
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
        for line in unified_diff(a, b, str(path), str(path))
    )

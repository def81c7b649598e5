"""What a command that handles many files says about those with errors.

In: the files with errors. Out: one line.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

_SHOWN = 5


def describe_left_out(paths: Sequence[Path], count: int, action: str) -> str:
    """The line for `paths` of `count` files; `action` is what was not done, as "exported"."""
    names = ", ".join(f"`{path}`" for path in paths[:_SHOWN])
    more = f" and {len(paths) - _SHOWN} more" if len(paths) > _SHOWN else ""
    have, are = ("has", "is") if len(paths) == 1 else ("have", "are")
    return f"{len(paths)} of {count} files {have} errors and {are} not {action}: {names}{more}"

"""Which of two similar names is spelled right, judged by the words around them.

In: two names, and the file with them. Out: a decision. A name is more plausible if more of its
words occur elsewhere in the file or in the interface library; else if more groups of three letters
do. `Pont3D` consists of `Pont`, which is nowhere else, `3` and `D`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.source import Source

_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_PART = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
_GROUPS = (3, 4)
"""Letters in a group: the longer ones decide if the shorter ones do not."""


def is_more_plausible(name: str, other: str, source: Source) -> bool:
    """Whether `name` rather than `other` is spelled right in `source`."""
    known = _parts(word for word in _NAME.findall(source.text) if word not in (name, other))
    for path, parts in _library().items():
        if path != source.path.resolve():
            known |= parts
    return _faults(name, known) < _faults(other, known)


def _faults(name: str, known: set[str]) -> tuple[int, ...]:
    """How many words of `name`, and how many groups of letters, occur nowhere else."""
    parts = _parts((name,))
    groups = (_groups(parts, size) - _groups(known, size) for size in _GROUPS)
    return len(parts - known), *(len(unknown) for unknown in groups)


def _parts(names: Iterable[str]) -> set[str]:
    """The words that names consist of, in small letters: `pose`, `3`, `d` for `Pose3D`."""
    return {part.lower() for name in names for part in _PART.findall(name)}


def _groups(parts: Iterable[str], size: int) -> set[str]:
    """The letters in a row that words consist of, with marks for their start and end."""
    padded = [f"^{part}$" for part in parts]
    return {part[at : at + size] for part in padded for at in range(len(part) - size + 1)}


@cache
def _library() -> Mapping[Path, set[str]]:
    """The words in each file of the interface library."""
    return {
        path.resolve(): _parts(_NAME.findall(path.read_text("utf-8", "replace")))
        for path in INTERFACES.glob("*.idsl")
    }

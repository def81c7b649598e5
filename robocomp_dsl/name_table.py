"""Unique names of one scope in another format. In: names. Out: valid names, no two of them equal.

Exporters use it, and transports that must know the exported names.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable


class NameTable:
    """Unique names of one scope in a format; names with the same `fold` are equal.

    `fit` makes a name valid in the format; a duplicate name gets a number, from 2 on.
    """

    def __init__(
        self,
        fit: Callable[[str], str],
        fold: Callable[[str], str] = str.lower,
        taken: Iterable[str] = (),
    ) -> None:
        self._fit = fit
        self._fold = fold
        self._taken = {fold(name) for name in taken}

    def claim(self, name: str) -> tuple[str, bool]:
        """A free name based on `name`, and whether a number was added."""
        fitting = self._fit(name)
        free, number = fitting, 1
        while self._fold(free) in self._taken:
            number += 1
            free = self._fit(f"{fitting}{number}")
        self._taken.add(self._fold(free))
        return free, number > 1

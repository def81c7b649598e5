"""What there is: the contexts of all roots, and the files of one.

In: roots. Out: names, and for each file of a context the places that have it, the winner first.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.runtime.config.find import CONTEXT
from robocomp_dsl.runtime.config.places import CONTEXTS, Place
from robocomp_dsl.runtime.config.surroundings import Root


def context_names(roots: Iterable[Root]) -> list[str]:
    """All contexts, those inside others too (`tests/left`), sorted."""
    made: set[str] = set()
    for root in roots:
        top = root.folder / CONTEXTS
        for folder, inside, _ in os.walk(top):
            inside[:] = [one for one in inside if not one.startswith(".")]
            name = Path(folder).relative_to(top).as_posix()
            if CONTEXT.fullmatch(name):
                made.add(name)
    return sorted(made)


def files_of(context: str, roots: Iterable[Root]) -> dict[str, list[Place]]:
    """File name to the places that have it; files of contexts inside belong to these."""
    made: dict[str, list[Place]] = {}
    for root in roots:
        place = Place(root, f"{CONTEXTS}/{context}")
        try:
            names = sorted(one.name for one in place.folder.iterdir() if one.is_file())
        except OSError:
            continue
        for name in names:
            if not name.startswith("."):
                made.setdefault(name, []).append(place)
    return dict(sorted(made.items()))

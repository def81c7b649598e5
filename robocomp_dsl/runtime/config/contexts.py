"""Lists the contexts of all roots, and the files of one context.

In: roots. Out: names of contexts; for each file of a context the search paths that have it, the
winner first.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.runtime.config.candidates import CONTEXT_NAME
from robocomp_dsl.runtime.config.search_environment import Root
from robocomp_dsl.runtime.config.search_paths import CONTEXTS, SearchPath


def context_names(roots: Iterable[Root]) -> list[str]:
    """All contexts, sorted, nested ones included (`tests/left`)."""
    names: set[str] = set()
    for root in roots:
        top = root.folder / CONTEXTS
        for folder, inside, _ in os.walk(top):
            inside[:] = [folder_name for folder_name in inside if not folder_name.startswith(".")]
            name = Path(folder).relative_to(top).as_posix()
            if CONTEXT_NAME.fullmatch(name):
                names.add(name)
    return sorted(names)


def files_of(context: str, roots: Iterable[Root]) -> dict[str, list[SearchPath]]:
    """File name to the search paths that have it; files of nested contexts are left out."""
    paths: dict[str, list[SearchPath]] = {}
    for root in roots:
        search_path = SearchPath(root, f"{CONTEXTS}/{context}")
        try:
            names = sorted(path.name for path in search_path.folder.iterdir() if path.is_file())
        except OSError:
            continue
        for name in names:
            if not name.startswith("."):
                paths.setdefault(name, []).append(search_path)
    return dict(sorted(paths.items()))

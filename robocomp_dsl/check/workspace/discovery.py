"""Discovers the description files in a folder.

In: a file or folder. Out: the files with a known suffix.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.languages import CHECKS, TACTILE
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES

SKIPPED_FOLDERS = ("__pycache__", "build", "node_modules")
"""Folders without descriptions; hidden folders are skipped as well."""

TACTILE_SUFFIX = f"tactile{TACTILE[0]}"
"""File name suffix of tactile descriptions: `nao.tactile.yaml`."""


def find_descriptions(path: Path) -> Iterator[Path]:
    """The file itself, or the descriptions in and below a folder, sorted."""
    if not path.is_dir():
        yield path
        return
    # XML files and definitions of ROS and YARP are checked only if the user names them: they are
    # not specific enough, and those that are imported are checked anyway.
    suffixes = (*(s for s in CHECKS if s not in (".xml", *DEFINITION_SUFFIXES)), TACTILE_SUFFIX)
    for folder, below, names in os.walk(path):
        below[:] = sorted(b for b in below if b not in SKIPPED_FOLDERS and not b.startswith("."))
        yield from (Path(folder, n) for n in sorted(names) if n.lower().endswith(suffixes))

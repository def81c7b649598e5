"""Which files of a folder are descriptions.

In: a file or folder that a user named, or has open. Out: the files whose language is known.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check import CHECKS, TACTILE

SKIPPED = ("__pycache__", "build", "node_modules")
"""Folders that hold no descriptions; hidden ones are skipped as well."""

TOUCH = f"tactile{TACTILE[0]}"
"""How the names of YAML files end that describe generic parts and skin: `nao.tactile.yaml`."""


def described(given: Path) -> Iterator[Path]:
    """The file itself, or those in and below a folder whose language is known, sorted."""
    if not given.is_dir():
        yield given
        return
    # An XML file may be anything; in a folder only those named by the user count.
    suffixes = (*(s for s in CHECKS if s != ".xml"), TOUCH)
    for folder, below, names in os.walk(given):
        below[:] = sorted(b for b in below if b not in SKIPPED and not b.startswith("."))
        yield from (Path(folder, n) for n in sorted(names) if n.lower().endswith(suffixes))

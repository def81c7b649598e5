"""Where the meshes and textures of a model file are.

In: a name as it is written, the file it stands in, and folders of packages. Out: a path, also where
nothing is there, so that the message can name it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import unquote

VARIABLES = ("ROBOCOMP_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH")
"""Folders with packages inside them, or packages themselves, with `:` between."""


def resolve(written: str, model: Path, packages: Sequence[Path] = ()) -> Path:
    """`package://NAME/PATH`, `model://NAME/PATH`, `file:///PATH`, or a path beside the model.

    A package is searched in `packages`, in the folders of `VARIABLES`, then in every folder
    above the model: itself, or beside it.
    """
    scheme, _, rest = written.partition("://")
    if not rest:
        return model.parent / written.replace("\\", "/")
    if scheme == "file":
        return Path("/" + unquote(rest).partition("/")[2].lstrip("/"))
    name, _, inside = unquote(rest).partition("/")
    candidates = [folder / inside for folder in _homes(name, model, packages)]
    fallback = model.parent / inside
    return next((path for path in candidates if path.is_file()), fallback)


def _homes(name: str, model: Path, packages: Sequence[Path]) -> Iterator[Path]:
    """Where the package `name` may be."""
    folders = [
        Path(entry) for var in VARIABLES for entry in os.environ.get(var, "").split(":") if entry
    ]
    for folder in (*packages, *folders):
        if folder.name == name:
            yield folder
        yield folder / name
        yield folder / "share" / name  # as an installed workspace has them
    for above in model.absolute().parents:
        if above.name == name:
            yield above
        yield above / name

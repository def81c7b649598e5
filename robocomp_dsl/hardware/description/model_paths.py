"""Finds the meshes and textures of a model file.

In: a name, the file that contains it, and folders of packages. Out: a path, even if no such file
exists, so that messages can show it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import unquote

VARIABLES = ("ROBOCOMP_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH")
"""Variables with folders of packages, or packages, separated by `:`."""


def resolve(written: str, model: Path, packages: Sequence[Path] = ()) -> Path:
    """`package://NAME/PATH`, `model://NAME/PATH`, `file:///PATH`, or a path beside the model.

    A package is searched in `packages`, in the folders of `VARIABLES`, then in every folder
    above the model: the folder itself, or a sibling.
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
    """Possible folders of the package `name`."""
    folders = [
        Path(entry) for var in VARIABLES for entry in os.environ.get(var, "").split(":") if entry
    ]
    for folder in (*packages, *folders):
        if folder.name == name:
            yield folder
        yield folder / name
        yield folder / "share" / name  # the layout of an installed workspace
    for above in model.absolute().parents:
        if above.name == name:
            yield above
        yield above / name

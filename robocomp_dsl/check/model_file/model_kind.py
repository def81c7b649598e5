"""Whether a file is a model of a robot, URDF or MJCF.

In: a path. Out: yes or no, by the suffix or the root tag.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.regular_file import open_regular

MODEL_SUFFIXES = (".urdf", ".mjcf")
_HEAD = 65536


def is_model(path: Path) -> bool:
    """Whether the file is a model by its suffix, or by the root tag of an XML file."""
    suffix = path.suffix.lower()
    if suffix != ".xml":
        return suffix in MODEL_SUFFIXES
    from robocomp_dsl.hardware.description.model_kind import MODELS, root_tag  # noqa: PLC0415

    try:
        with open_regular(path) as file:
            return root_tag(file.read(_HEAD)) in MODELS
    except OSError:
        return False

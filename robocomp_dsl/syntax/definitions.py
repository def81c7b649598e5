"""The kinds of imported definitions: files of ROS and YARP that are read as IDSL modules.

They belong to other programs: the formatter leaves them as they are, no name in them is renamed,
and they are checked only if they are named or imported.
"""

from __future__ import annotations

import re
from pathlib import Path

from robocomp_dsl.syntax.ros.kinds import ROS_SUFFIXES

THRIFT_SUFFIX = ".thrift"
BOTTLE_SUFFIX = ".bottle"
YARP_SUFFIXES = (THRIFT_SUFFIX, BOTTLE_SUFFIX)
DEFINITION_SUFFIXES = (*ROS_SUFFIXES, *YARP_SUFFIXES)
"""The suffixes of all imported definitions."""


def module_name(path: Path) -> str:
    """The name of the module of a YARP definition: that of its file, with `_` for other signs."""
    name = re.sub(r"\W", "_", path.stem, flags=re.ASCII)
    return name if name[:1].isalpha() or name.startswith("_") else f"_{name}"

"""The language of a model file, from its root tag."""

from __future__ import annotations

import re

_OUTERMOST = re.compile(rb"<\s*([A-Za-z_][\w.:-]*)")
_SKIPPED = re.compile(rb"<!--.*?-->|<\?.*?\?>|<!DOCTYPE[^>]*>", re.DOTALL)

MODELS = {"robot": ".urdf", "mujoco": ".xml", "mujocoinclude": ".xml"}
"""The root tags of URDF, MJCF and included MJCF files, and the end of their file names."""


def root_tag(data: bytes) -> str:
    """The root tag, in lower case; empty if there is none."""
    found = _OUTERMOST.search(_SKIPPED.sub(b"", data))
    return found[1].decode().lower() if found else ""

"""The language of a model file, by the first tag in it."""

from __future__ import annotations

import re

_OUTERMOST = re.compile(rb"<\s*([A-Za-z_][\w.:-]*)")
_SKIPPED = re.compile(rb"<!--.*?-->|<\?.*?\?>|<!DOCTYPE[^>]*>", re.DOTALL)

MODELS = {"robot": ".urdf", "mujoco": ".xml", "mujocoinclude": ".xml"}
"""The outermost tags of URDF, MJCF and of parts of MJCF, and how their files end."""


def root_tag(data: bytes) -> str:
    """The first tag, in lower case; empty if there is none."""
    found = _OUTERMOST.search(_SKIPPED.sub(b"", data))
    return found[1].decode().lower() if found else ""

"""The library `packaging`, which the extra `hosts` installs: requirements and names of wheels."""

from __future__ import annotations

from robocomp_dsl.extras import MissingExtra

try:
    from packaging.requirements import InvalidRequirement, Requirement
    from packaging.utils import InvalidWheelFilename, canonicalize_name, parse_wheel_filename
except ModuleNotFoundError as error:
    raise MissingExtra("a deployment over several hosts", "hosts", error) from None

__all__ = [
    "InvalidRequirement",
    "InvalidWheelFilename",
    "Requirement",
    "canonicalize_name",
    "parse_wheel_filename",
]

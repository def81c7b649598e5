"""The generated package of any component."""

from __future__ import annotations

from pathlib import Path


def package_in(folder: Path) -> Path:
    """The one generated package in the folder of a component."""
    (package,) = folder.glob("*_generated")
    return package


def with_package(folder: Path, code: str) -> str:
    """`code` with the name of that package in the place of `PACKAGE`."""
    return code.replace("PACKAGE", package_in(folder).name)
